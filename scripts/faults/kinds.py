"""Kinds of faults by name, their keys, and how a fault is written: KIND:key=value,..."""

import inspect

import numpy

from faults.recording import FaultError

KINDS = {}


def fault(function):
    KINDS[function.__name__] = function
    return function


def keys_of(kind):
    return {name: p for name, p in inspect.signature(KINDS[kind]).parameters.items() if p.kind == p.KEYWORD_ONLY}


def parse_fault(text):
    """Kind and its keys of KIND:key=value,..."""
    kind, _, rest = text.partition(":")
    if kind not in KINDS:
        raise FaultError(f"kind '{kind}' is not known; need one of {', '.join(KINDS)}")
    keys, given = keys_of(kind), {}
    for item in filter(None, rest.split(",")):
        key, equals, value = item.partition("=")
        if not equals or key not in keys or key in given:
            what = "is not key=value" if not equals else "comes twice" if key in given else "is not known"
            raise FaultError(f"{kind}: '{item}' {what}; the keys are {', '.join(keys)}")
        if keys[key].annotation is float:
            try:
                given[key] = float(value)
            except ValueError:
                given[key] = numpy.nan
            if not numpy.isfinite(given[key]):
                raise FaultError(f"{kind}: {key} is '{value}'; need a number")
        else:
            given[key] = value
    missing = [key for key, p in keys.items() if p.default is p.empty and key not in given]
    if missing:
        raise FaultError(f"{kind}: {missing[0]} is missing; the keys are {', '.join(keys)}")
    return kind, given


def help_text():
    lines = ["kinds of faults, with their keys; those in brackets may be left out:"]
    for kind, function in KINDS.items():
        keys = [name if p.default is p.empty else f"[{name}]" for name, p in keys_of(kind).items()]
        lines += ["", f"  {kind}: {', '.join(keys)}", "    " + inspect.getdoc(function).replace("\n", "\n    ")]
    return "\n".join(lines)
