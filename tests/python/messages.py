"""Checks of messages by their facts: locations, names, keys, options and numbers with units, whatever the wording."""

import contextlib
import re


def assert_mentions(text, facts):
    """Each fact is in the text, or in one of several texts, and not inside a longer name or number."""
    text = text if isinstance(text, str) else "\n".join(text)
    for fact in [facts] if isinstance(facts, str) else map(str, facts):
        start, end = (r"(?<!\w)" if fact[:1].isalnum() else ""), (r"(?!\w)" if fact[-1:].isalnum() else "")
        assert re.search(start + re.escape(fact) + end, text), f"no {fact!r} in\n{text}"


@contextlib.contextmanager
def raises(kind, facts=()):
    """The block raises an exception of this kind whose message contains the facts."""
    try:
        yield
    except kind as error:
        assert_mentions(str(error), facts)
    else:
        raise AssertionError(f"no {kind.__name__}, which should mention {facts}")
