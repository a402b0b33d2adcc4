"""Plots by matplotlib, which is imported here only."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from ._chosen import Points
    from ._comparison import Comparison
    from ._persistence import Diagram
    from ._points import CriticalPoints
    from ._sweep import Stability, Sweep

BLUE, GREEN, RED, GREY = "#2166ac", "#1b9e4b", "#b2182b", "#9a9a9a"
OF_TYPE = {1: (BLUE, "minima"), 2: (GREEN, "saddles"), 3: (RED, "maxima")}


def _axes(ax: Any, **kind: Any) -> Any:
    if ax is not None:
        return ax
    from matplotlib import pyplot

    return pyplot.figure(layout="constrained").add_subplot(**kind)


def diagram(d: Diagram, ax: Any = None) -> Any:
    """A persistence diagram: birth against death."""
    ax = _axes(ax)
    pairs = d.pairs[:len(d.finite)]
    for kind, color, name in ((0, BLUE, "minimum-saddle"), (1, RED, "saddle-maximum")):
        of = pairs[pairs["kind"] == kind]
        ax.scatter(of["birth"], of["death"], s=8, color=color, alpha=0.6, linewidths=0, label=name)
    ends = [d.field.min, d.field.max]
    ax.plot(ends, ends, color=GREY, linewidth=0.8, zorder=0)
    caps = d.pairs[len(pairs):]
    if len(caps):
        ax.scatter(caps["birth"], np.full(len(caps), d.field.max), s=24, marker="^", color=GREY,
                   label="boundary loop (infinite)")
    ax.set_xlabel("birth")
    ax.set_ylabel("death")
    ax.set_aspect("equal", adjustable="box")
    ax.legend(loc="lower right", frameon=False)
    return ax


def diagrams(comparison: Comparison, axes: Any = None) -> Any:
    """The diagrams of a comparison side by side, with the same limits."""
    if axes is None:
        from matplotlib import pyplot

        _, axes = pyplot.subplots(1, len(comparison), figsize=(4 * len(comparison), 4), layout="constrained",
                                  sharex=True, sharey=True, squeeze=False)
        axes = axes[0]
    for ax, row in zip(axes, comparison):
        diagram(row.diagram, ax)
        ax.set_title(row.specification)
    return axes


def points(p: CriticalPoints | Points, mesh: Any = None, ax: Any = None) -> Any:
    """A surface, grey, with critical points on it."""
    from ._mesh import as_mesh

    on = p.field.mesh if mesh is None else as_mesh(mesh)
    if on.vertex_count != p.field.mesh.vertex_count:
        raise ValueError(f"the mesh has {on.vertex_count:,} vertices, the field's mesh "
                         f"{p.field.mesh.vertex_count:,}")
    ax = _axes(ax, projection="3d", computed_zorder=False)
    x, y, z = on.vertices.T
    ax.plot_trisurf(x, y, z, triangles=on.faces.astype(np.int64), color="#d8d8d8", linewidth=0,
                    antialiased=False, shade=True, zorder=1)
    for kind, (color, name) in OF_TYPE.items():
        of = on.vertices[p.vertex[p.type == kind]]
        ax.scatter(*of.T, color=color, s=10, depthshade=False, label=f"{len(of):,} {name}", zorder=2)
    spans = np.ptp(on.vertices, axis=0)
    ax.set_box_aspect(np.maximum(spans, 1e-9 * max(spans.max(), 1e-300)))
    ax.set_axis_off()
    ax.legend(loc="upper right", frameon=False)
    return ax


def counts(comparison: Comparison, ax: Any = None) -> Any:
    """Stacked bars of minima, saddles and maxima, a bar a method."""
    ax = _axes(ax)
    names = [row.specification for row in comparison]
    bottom = np.zeros(len(names))
    for kind, of in ((1, "minima"), (2, "saddles"), (3, "maxima")):
        heights = np.array([getattr(row.counts, of) for row in comparison])
        ax.bar(np.arange(len(names)), heights, bottom=bottom, color=OF_TYPE[kind][0], label=of)
        bottom += heights
    for place, total in enumerate(bottom):
        ax.annotate(f"{total:,.0f}", (place, total), ha="center", va="bottom")
    ax.set_ylabel("critical points")
    ax.set_xticks(np.arange(len(names)), names, rotation=20)
    ax.legend(frameon=False)
    return ax


def sweep(s: Sweep, key: str | None = None, ax: Any = None) -> Any:
    """Critical points against one key."""
    ax = _axes(ax)
    key = key if key is not None else s.keys[0]
    others = [other for other in s.keys if other != key]
    lines: dict[tuple[str, ...], list[tuple[str, int]]] = {}
    for row in s:
        lines.setdefault(tuple(row[other] for other in others), []).append((row[key], row["total"]))
    for values, line in lines.items():
        label = ", ".join(f"{other}={value}" for other, value in zip(others, values))
        x, y = zip(*line)
        try:
            ax.plot([float(value) for value in x], y, marker="o", label=label)
        except ValueError:
            ax.plot(list(x), y, marker="o", label=label)
    ax.set_xlabel(key)
    ax.set_ylabel("critical points")
    ax.set_ylim(bottom=0)
    if others:
        ax.legend(frameon=False)
    return ax


AMOUNTS = {"noise": "noise (mean edge lengths)", "decimation": "share of the vertices that is left",
           "subdivision": "pieces of an edge"}


def stability(s: Stability, quantity: str = "f_score", perturbation: str | None = None,
              ax: Any = None) -> Any:
    """A quantity against the amount of one kind of perturbation."""
    kinds = list(dict.fromkeys(row["perturbation"] for row in s))
    if perturbation is None:
        perturbation = kinds[0]
    if perturbation not in kinds:
        raise ValueError(f"the study has {', '.join(kinds)}, not {perturbation!r}")
    ax = _axes(ax)
    fields = {row["field"] for row in s}
    lines: dict[str, list[Any]] = {}
    for row in s:
        if row["perturbation"] != perturbation:
            continue
        field = f"{row['field']}, " if len(fields) > 1 else ""
        target = f", {row['target']} points" if row["target"] is not None else ""
        lines.setdefault(f"{field}{row['method']}{target}", []).append(row)
    for name, rows in lines.items():
        means = [row[quantity].mean for row in rows]
        errors = [row[quantity].half_width or 0 for row in rows]
        ax.errorbar([row["amount"] for row in rows], means, yerr=errors, marker="o", capsize=3, label=name)
    ax.set_xlabel(AMOUNTS[perturbation])
    ax.set_ylabel(quantity.replace("_", "-"))
    if quantity not in ("drift", "found"):
        ax.set_ylim(0, 1.02)
    ax.legend(frameon=False)
    return ax
