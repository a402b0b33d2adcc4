"""Odd arrays and arguments, at random: exceptions only, and of the kinds that are documented.

MORSEL_ODD_CALLS calls (400 if it is not set), from the seed MORSEL_ODD_SEED (1).
"""

import os
import random
import warnings

import numpy as np
from conftest import OCTAHEDRON_F, OCTAHEDRON_V

import morsel as ms

CALLS = int(os.environ.get("MORSEL_ODD_CALLS", "400"))
SEED = int(os.environ.get("MORSEL_ODD_SEED", "1"))
TYPES = ["f2", "f4", "f8", "g", "i1", "i2", "i4", "i8", "u1", "u2", "u4", "u8", ">f8", ">i4", "?", "c16",
         "U3", "S2",
         "O", "M8[s]", "m8[s]", [("a", "f8"), ("b", "i4")]]
ALLOWED = (ValueError, TypeError, OverflowError, IndexError, KeyError, OSError, ms.Error, MemoryError)
NUMBERS = [0, 1, -1, 2, 5, 6, 2**31, 2**32 - 1, 2**32, 2**63 - 1, -2**63, 0.5, -0.0, np.nan, np.inf, -np.inf,
           1e300,
           1e-300, True]
WORDS = ["", "0", "1", "-1", "8eps", "5%", "none", "x", "1/2/3", "1,2", "a:b", "a+b", "\\", "a=b", "\0", "é",
         "\udcff",
         "x" * 5000, "%s%n", "1e999", "nan"]


def a_shape(random_):
    sizes = [0, 1, 2, 3, 3, 3, 4, 5, 6, 6, 8, 12]
    return tuple(random_.choice(sizes) for _ in range(random_.choice([0, 1, 1, 2, 2, 2, 2, 3])))


def an_array(random_):
    """Any shape, type, layout and contents."""
    base = random_.choice([OCTAHEDRON_V, OCTAHEDRON_F, None, None])
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore")
        if base is None:
            shape = a_shape(random_)
            count = int(np.prod(shape))
            made = np.array([random_.choice(NUMBERS) for _ in range(count)], dtype=object).reshape(shape)
            try:
                made = made.astype(random_.choice(TYPES))
            except (ValueError, TypeError, OverflowError):
                made = np.zeros(shape, random_.choice(TYPES))
        else:
            made = base.copy()
            if random_.random() < 0.4:
                made = made.astype(random_.choice(["f4", "f8", "i1", "i4", "i8", "u8", ">f8", ">i4"]))
            for _ in range(random_.choice([0, 0, 1, 3])):
                try:
                    made[tuple(random_.randrange(size) for size in made.shape)] = random_.choice(NUMBERS)
                except (ValueError, OverflowError):
                    pass
            if random_.random() < 0.3:
                made = made[random_.sample(range(len(made)), random_.randrange(len(made) + 1))]
    change = random_.choice(["", "", "", "T", "F", "[::-1]", "[::2]", "broadcast", "list", "readonly",
                             "matrix", "offset"])
    if change == "T":
        made = made.T
    elif change == "F":
        made = np.asfortranarray(made)
    elif change == "[::-1]" and made.ndim:
        made = made[::-1]
    elif change == "[::2]" and made.ndim:
        made = made[..., ::2]
    elif change == "broadcast":
        made = np.broadcast_to(made, (3, *made.shape)) if made.ndim < 2 else made
    elif change == "list":
        made = made.tolist()
    elif change == "readonly":
        made.flags.writeable = False
    elif change == "offset" and made.ndim and made.dtype.kind in "fiu":
        raw = np.zeros(made.nbytes + 1, np.uint8)[1:].view(made.dtype).reshape(made.shape)
        raw[...] = made
        made = raw
    return made


def a_value(random_):
    return random_.choice([lambda: random_.choice(NUMBERS), lambda: random_.choice(WORDS),
                           lambda: an_array(random_), lambda: None, object, list, dict,
                           lambda: [random_.choice(WORDS)], lambda: [random_.choice(NUMBERS)],
                           lambda: random_.choice([ms.salient, ms.height])])()


def keys_of(function, random_):
    """Some of a function's arguments with odd values; iterations stay few."""
    import inspect

    names = [name for name in list(inspect.signature(function).parameters)[1:]
             if name not in ("progress", "iterations", "self", "args", "keys", "faces", "path")]
    keys = {name: a_value(random_)
            for name in random_.sample(names, min(len(names), random_.choice([0, 1, 1, 2])))}
    if "iterations" in inspect.signature(function).parameters:
        keys["iterations"] = random_.choice([0, 1, 2, 2.0, -1, "3", None])
    return keys


def odd_call(random_, mesh, f):
    """One call with odd arguments."""
    choice = random_.randrange(10)
    if choice < 3:
        made = ms.Mesh(an_array(random_), an_array(random_), repair=random_.choice([True, False, 0, "x"]))
        return ms.critical_points(ms.height(made))
    if choice == 3:
        return ms.defects(an_array(random_), an_array(random_))
    if choice < 6:
        g = ms.field(mesh, an_array(random_), ranks=random_.choice([None, None, an_array(random_)]))
        return ms.morse_smale(g).polylines
    if choice == 6:
        return ms.critical_points(f)[a_value(random_)]
    if choice == 7:
        name = random_.choice([*ms.functions(), *ms.methods()]).replace("-", "_")
        function = getattr(ms, name)
        return function(random_.choice([f, mesh, an_array(random_)]), **keys_of(function, random_))
    if choice == 8:
        function = random_.choice([ms.segment, ms.points, ms.cut, ms.hierarchy, ms.compare, ms.quads])
        return function(random_.choice([f, f, mesh]), **keys_of(function, random_))
    method = random_.choice([lambda: mesh.length(a_value(random_)),
                             lambda: mesh.with_vertices(an_array(random_)),
                             lambda: f.apply(random_.choice(WORDS)),
                             lambda: ms.hierarchy(f)[a_value(random_)],
                             lambda: ms.morse_smale(f).arcs_around(a_value(random_)),
                             lambda: ms.persistence(f).count_above(a_value(random_)),
                             lambda: ms.sweep(mesh, {random_.choice(WORDS): a_value(random_)}),
                             lambda: ms.threads(a_value(random_)), lambda: ms.read(a_value(random_)),
                             lambda: mesh.subdivided(random_.choice([0, -1, 2, 3, "x", 2**40]))])
    return method()


def test_odd_calls():
    random_ = random.Random(SEED)
    mesh = ms.Mesh(OCTAHEDRON_V, OCTAHEDRON_F).subdivided(3)
    f = ms.field(mesh, np.sin(7.0 * np.arange(mesh.vertex_count)))
    before = f.values.copy()
    raised = 0
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for number in range(CALLS):
            try:
                odd_call(random_, mesh, f)
            except ALLOWED:
                raised += 1
            except Exception as error:
                raise AssertionError(f"call {number} of seed {SEED} raised {type(error).__name__}") from error
    assert CALLS / 4 < raised < CALLS
    assert np.array_equal(f.values, before)
