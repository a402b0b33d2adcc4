# Written by python/make_stub.
from os import PathLike
from typing import Any, Sequence

from ._field import Field, OnIteration
from ._progress import Progress

class _Shipped:
    name: str
    __name__: str
    def spec(self, **keys: Any) -> str: ...

class _atomic_density(_Shipped):
    def __call__(
        self,
        mesh: Any,
        *,
        structure: float | str | PathLike[str] | None = None,
        decay: float | str = 0.5,
        cutoff: float | str = 1e-12,
        weight: str = 'one',
        hetero: str = 'residues',
        waters: bool = False,
        hydrogens: bool = True,
        altloc: float | str | PathLike[str] = 'highest',
        chains: str | Sequence[float | str | PathLike[str]] | None = None,
        model: int = 1,
        select: float | str | PathLike[str] | None = None,
        radii: float | str | PathLike[str] = 'auto',
        progress: Progress = None,
    ) -> Field: ...

atomic_density: _atomic_density

class _curvedness(_Shipped):
    def __call__(
        self,
        mesh: Any,
        *,
        estimator: str = 'quadric',
        scale: float | str = 0.0,
        radius: float | str = '0.015rootarea',
        progress: Progress = None,
    ) -> Field: ...

curvedness: _curvedness

class _eigenfunction(_Shipped):
    def __call__(
        self,
        mesh: Any,
        *,
        index: int = 1,
        progress: Progress = None,
    ) -> Field: ...

eigenfunction: _eigenfunction

class _gaussian_curvature(_Shipped):
    def __call__(
        self,
        mesh: Any,
        *,
        estimator: str = 'defect',
        scale: float | str = 0.0,
        radius: float | str = '0.015rootarea',
        spread: float | str = '20%',
        fairing: float | str = '0.8%',
        progress: Progress = None,
    ) -> Field: ...

gaussian_curvature: _gaussian_curvature

class _geodesic(_Shipped):
    def __call__(
        self,
        mesh: Any,
        *,
        mode: str = 'distance',
        source: str | Sequence[float | str | PathLike[str]] | None = None,
        samples: int = 50,
        time: float | str = 1.0,
        boundary: str = 'average',
        delaunay: bool = True,
        progress: Progress = None,
    ) -> Field: ...

geodesic: _geodesic

class _heat_kernel_signature(_Shipped):
    def __call__(
        self,
        mesh: Any,
        *,
        time: float | str = '0.1rootarea',
        modes: int = 100,
        progress: Progress = None,
    ) -> Field: ...

heat_kernel_signature: _heat_kernel_signature

class _height(_Shipped):
    def __call__(
        self,
        mesh: Any,
        *,
        axis: str = 'z',
        direction: str | Sequence[float | str | PathLike[str]] | None = None,
        progress: Progress = None,
    ) -> Field: ...

height: _height

class _mean_curvature(_Shipped):
    def __call__(
        self,
        mesh: Any,
        *,
        estimator: str = 'taubin',
        scale: float | str = 0.0,
        radius: float | str = '0.015rootarea',
        diffusion: float | str = '0.036rootarea',
        progress: Progress = None,
    ) -> Field: ...

mean_curvature: _mean_curvature

class _principal_curvature(_Shipped):
    def __call__(
        self,
        mesh: Any,
        *,
        which: str = 'max',
        estimator: str = 'quadric',
        scale: float | str = 0.0,
        radius: float | str = '0.015rootarea',
        progress: Progress = None,
    ) -> Field: ...

principal_curvature: _principal_curvature

class _shape_index(_Shipped):
    def __call__(
        self,
        mesh: Any,
        *,
        estimator: str = 'quadric',
        scale: float | str = 0.0,
        radius: float | str = '0.015rootarea',
        progress: Progress = None,
    ) -> Field: ...

shape_index: _shape_index

class _vertex_scalar(_Shipped):
    def __call__(
        self,
        mesh: Any,
        *,
        file: float | str | PathLike[str] | None = None,
        property: float | str | PathLike[str] | None = None,
        column: float | str | PathLike[str] | None = None,
        progress: Progress = None,
    ) -> Field: ...

vertex_scalar: _vertex_scalar

class _wave_kernel_signature(_Shipped):
    def __call__(
        self,
        mesh: Any,
        *,
        energy: float | str = 0.5,
        width: float | str = 0.07,
        modes: int = 100,
        progress: Progress = None,
    ) -> Field: ...

wave_kernel_signature: _wave_kernel_signature

class _conventional(_Shipped):
    def __call__(
        self,
        f: Field,
        *,
        target: int | None = None,
        count_iterations: bool = False,
        on_iteration: OnIteration | None = None,
        progress: Progress = None,
    ) -> Field: ...

conventional: _conventional

class _denoise(_Shipped):
    def __call__(
        self,
        f: Field,
        *,
        iterations: int = 5,
        until_count: float | str | PathLike[str] | None = None,
        until_stable: float | str | PathLike[str] | None = None,
        until_change: float | str | PathLike[str] | None = None,
        kind: str = 'bilateral',
        sigma_c: float | str | PathLike[str] = 'edge',
        sigma_s: float | str | PathLike[str] = 'auto',
        lambda_: float | str = 0.5,
        weights: str = 'uniform',
        target: int | None = None,
        count_iterations: bool = False,
        on_iteration: OnIteration | None = None,
        progress: Progress = None,
    ) -> Field: ...

denoise: _denoise

class _fair(_Shipped):
    def __call__(
        self,
        f: Field,
        *,
        extrema: int = 8,
        values: str = 'ends',
        weights: str = 'clamped',
        target: int | None = None,
        count_iterations: bool = False,
        on_iteration: OnIteration | None = None,
        progress: Progress = None,
    ) -> Field: ...

fair: _fair

class _gaussian(_Shipped):
    def __call__(
        self,
        f: Field,
        *,
        iterations: int = 1,
        until_count: float | str | PathLike[str] | None = None,
        until_stable: float | str | PathLike[str] | None = None,
        until_change: float | str | PathLike[str] | None = None,
        sigma: float | str = '8eps',
        support: float | str = 2.0,
        weights: str = 'none',
        ball: str = 'euclidean',
        target: int | None = None,
        count_iterations: bool = False,
        on_iteration: OnIteration | None = None,
        progress: Progress = None,
    ) -> Field: ...

gaussian: _gaussian

class _laplacian(_Shipped):
    def __call__(
        self,
        f: Field,
        *,
        iterations: int = 10,
        until_count: float | str | PathLike[str] | None = None,
        until_stable: float | str | PathLike[str] | None = None,
        until_change: float | str | PathLike[str] | None = None,
        scheme: str = 'explicit',
        weights: str = 'uniform',
        lambda_: float | str = 0.5,
        time: float | str = '0.006rootarea',
        target: int | None = None,
        count_iterations: bool = False,
        on_iteration: OnIteration | None = None,
        progress: Progress = None,
    ) -> Field: ...

laplacian: _laplacian

class _saliency(_Shipped):
    def __call__(
        self,
        f: Field,
        *,
        scales: str | Sequence[float | str | PathLike[str]] =
            '0.006rootarea/0.009rootarea/0.012rootarea/0.015rootarea/0.018rootarea',
        suppression: str = 'itti',
        support: float | str = 2.0,
        weights: str = 'none',
        ball: str = 'euclidean',
        target: int | None = None,
        count_iterations: bool = False,
        on_iteration: OnIteration | None = None,
        progress: Progress = None,
    ) -> Field: ...

saliency: _saliency

class _salient(_Shipped):
    def __call__(
        self,
        f: Field,
        *,
        preset: str = 'paper',
        iterations: int = 10,
        until_count: float | str | PathLike[str] | None = None,
        until_stable: float | str | PathLike[str] | None = None,
        until_change: float | str | PathLike[str] | None = None,
        sigma: float | str = '8eps',
        range: float | str | PathLike[str] = '1std',
        support: float | str = 2.0,
        classify: str = 'smoothed',
        precision: str = 'double',
        accuracy: float | str = 0.0,
        weights: str = 'none',
        ball: str = 'euclidean',
        scale: float | str = 0.0,
        target: int | None = None,
        count_iterations: bool = False,
        on_iteration: OnIteration | None = None,
        progress: Progress = None,
    ) -> Field: ...

salient: _salient

class _spectral(_Shipped):
    def __call__(
        self,
        f: Field,
        *,
        modes: int = 20,
        target: int | None = None,
        count_iterations: bool = False,
        on_iteration: OnIteration | None = None,
        progress: Progress = None,
    ) -> Field: ...

spectral: _spectral

class _tps(_Shipped):
    def __call__(
        self,
        f: Field,
        *,
        threshold: float | str | PathLike[str] = '0.1%',
        count: float | str | PathLike[str] | None = None,
        target: int | None = None,
        count_iterations: bool = False,
        on_iteration: OnIteration | None = None,
        progress: Progress = None,
    ) -> Field: ...

tps: _tps

__all__ = [
    "atomic_density",
    "curvedness",
    "eigenfunction",
    "gaussian_curvature",
    "geodesic",
    "heat_kernel_signature",
    "height",
    "mean_curvature",
    "principal_curvature",
    "shape_index",
    "vertex_scalar",
    "wave_kernel_signature",
    "conventional",
    "denoise",
    "fair",
    "gaussian",
    "laplacian",
    "saliency",
    "salient",
    "spectral",
    "tps",
]
