"""Rewards and ends as expressions over the truth of a simulation.

    reward="100 * change_load_m3 - 1e-5 * change_work_j", terminated="tilt_rad > 0.4 or touches > 0"

Names, all numbers of the machine after a step:

    time_s                                since the reset
    load_kg, load_m3                      soil in all its shovels
    tilt_rad                              between its z axis and the vertical
    work_j                                of its driving joints and gears since the reset
    touches                               obstacles and machines that it touches
    x_m, y_m, z_m, speed_mps              of its root link in W
    change_NAME                           NAME less what it was a step ago; 0 after a reset

An expression is Python's: + - * / ** %, comparisons, and, or, not, `a if b else c`, and the functions abs, min, max,
sqrt, exp, log, sin, cos, tanh. Nothing else is possible in it.
"""

import ast
import math

FUNCTIONS = {"abs": abs, "min": min, "max": max, "sqrt": math.sqrt, "exp": math.exp, "log": math.log, "sin": math.sin,
             "cos": math.cos, "tanh": math.tanh}
_NUMBERS = ("time_s", "load_kg", "load_m3", "tilt_rad", "work_j", "touches", "x_m", "y_m", "z_m", "speed_mps")
NAMES = (*_NUMBERS, *(f"change_{name}" for name in _NUMBERS))

_NODES = (ast.Expression, ast.BinOp, ast.UnaryOp, ast.BoolOp, ast.Compare, ast.IfExp, ast.Call, ast.Name, ast.Constant,
          ast.Load, ast.operator, ast.unaryop, ast.boolop, ast.cmpop)


def of_state(state, time_s, before):
    """The numbers of a MachineState; `before` are those of a step ago, None after a reset."""
    p, q, v = state.X_WB.position_m, state.X_WB.rotation, state.v_WB_mps
    up = 1 - 2 * (q.x * q.x + q.y * q.y)  # of B's z axis along W's
    truth = {"time_s": time_s, "load_kg": sum(state.shovel_load_kg), "load_m3": sum(state.shovel_load_m3),
             "tilt_rad": math.acos(max(-1.0, min(1.0, up))), "work_j": state.work_j, "touches": len(state.touches),
             "x_m": p.x, "y_m": p.y, "z_m": p.z, "speed_mps": math.hypot(v.x, v.y, v.z)}
    for name in _NUMBERS:
        truth[f"change_{name}"] = truth[name] - before[name] if before else 0.0
    return truth


def function_of(given, otherwise):
    """A function of (observation, info): `given` itself, or that of the expression `given`, or a constant."""
    if given is None:
        return lambda observation, info: otherwise
    if not isinstance(given, str):
        return given
    code = _compiled(given)
    return lambda observation, info: eval(code, {"__builtins__": {}, **FUNCTIONS}, info["truth"])


def _compiled(text):
    try:
        tree = ast.parse(text, mode="eval")
    except SyntaxError as error:
        raise ValueError(f"expression {text!r}: {error.msg}; need one of Python's") from None
    called = {id(node.func) for node in ast.walk(tree) if isinstance(node, ast.Call)}
    for node in ast.walk(tree):
        if not isinstance(node, _NODES) or (isinstance(node, ast.Call) and node.keywords):
            raise ValueError(f"expression {text!r}: {type(node).__name__} is not possible; need numbers, names, "
                             f"operators and the functions {', '.join(FUNCTIONS)}")
        if isinstance(node, ast.Call) and not isinstance(node.func, ast.Name):
            raise ValueError(f"expression {text!r}: a call of no function's name; need one of {', '.join(FUNCTIONS)}")
        if isinstance(node, ast.Constant) and not isinstance(node.value, (int, float)):
            raise ValueError(f"expression {text!r}: {node.value!r} is no number")
        if isinstance(node, ast.Name):
            known = FUNCTIONS if id(node) in called else NAMES
            if node.id not in known:
                raise ValueError(f"expression {text!r}: no {'function' if id(node) in called else 'truth'} "
                                 f"{node.id!r}; need one of {', '.join(known)}")
    return compile(tree, text, "eval")
