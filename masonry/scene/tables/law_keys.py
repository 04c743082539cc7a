"""Keys that a law of another package adds to the contacts of a scene: with units and messages as all others."""

import re
from collections.abc import Iterable, Iterator
from functools import cache
from typing import Annotated, Any

from pydantic import SerializeAsAny, ValidationInfo, ValidatorFunctionWrapHandler, WrapValidator, create_model

from masonry.errors import SceneError, nearest
from masonry.laws import law_names
from masonry.laws.building.plugins import plugin_law, plugin_law_names
from masonry.quantity import KINDS, is_interval
from masonry.scene.tables.contact_group import Contact
from masonry.scene.tables.types import Given


def law_there(name: Any) -> bool:
    """Whether there is a law of that name; raises SceneError for one of another package that does not work."""
    if isinstance(name, str) and name not in law_names() and plugin_law(name) is not None:
        keys_of(name)
        return True
    return name in law_names()


def is_law(name: Any) -> bool:
    """Whether a law of that name is there and works."""
    try:
        return law_there(name)
    except SceneError:
        return False


def contact_class(law: Any, scene_keys: Iterable[str]) -> type[Contact]:
    """The table of a contact group: `Contact`, with the keys of a law of another package.

    scene_keys  the keys that a scene has there; those of laws that it does not use pass, as those of ours do
    """
    keys: dict[str, Given] = {} if law in law_names() or not is_law(law) else keys_of(law)
    unknown = set(scene_keys) - set(Contact.model_fields) - set(keys)
    if unknown:
        keys = dict(_of_others(unknown)) | keys
    return _with_keys(tuple(keys.items())) if keys else Contact


@cache
def keys_of(law: str) -> dict[str, Given]:
    """Own keys of a law of another package, with what they hold; SceneError where they do not fit into a scene."""
    plugin = plugin_law(law)
    assert plugin is not None
    where = f"law '{law}' of {plugin.origin}"
    for key in plugin.keys:
        if key in Contact.model_fields or not key.isidentifier() or key.startswith("_"):
            raise SceneError(
                f"{where}: KEYS: '{key}' cannot be a key of its own: every contact has it, or no scene can"
            )
    for key in plugin.parameters.values():
        if key not in plugin.keys and key not in Contact.model_fields:
            raise SceneError(f"{where}: no contact has the key '{key}'; name its kind: KEYS = {{'{key}': 'stress'}}")
    return {key: _given(where, key, text) for key, text in plugin.keys.items()}


def _given(where: str, key: str, text: str) -> Given:
    """Of a kind of quantity, with or without an interval: "length", "number (0, 1)"."""
    kind, left, rest = re.fullmatch(r"([^\[(]*)([\[(]?)(.*)", text, re.DOTALL).groups()  # type: ignore[union-attr]
    kind, allowed = kind.strip(), left + rest if left else "(-inf, inf)"
    if kind not in KINDS:
        raise SceneError(f"{where}: KEYS: '{kind}' of '{key}' is no kind of quantity; {nearest(kind, KINDS)}")
    if not is_interval(allowed):
        raise SceneError(f"{where}: KEYS: '{allowed}' of '{key}' is no interval such as [0, 1) or (0, inf)")
    return Given(kind, allowed)


def _of_others(unknown: set[str]) -> Iterator[tuple[str, Given]]:
    """Which of some keys are those of any law of another package that works, with what they hold."""
    for law in filter(is_law, plugin_law_names()):
        try:
            yield from ((key, quantity) for key, quantity in keys_of(law).items() if key in unknown)
        except SceneError:
            continue


@cache
def _with_keys(keys: tuple[tuple[str, Given], ...]) -> type[Contact]:
    fields: dict[str, Any] = {key: (Annotated[float, quantity] | None, None) for key, quantity in keys}
    made: type[Contact] = create_model("Contact", __base__=Contact, **fields)
    return made


def _of_its_law(data: Any, handler: ValidatorFunctionWrapHandler, info: ValidationInfo) -> Contact:
    """The table of its law, where that is not the usual one. Keys of a law that is not there are not told as well."""
    context = info.context or {}
    if isinstance(data, dict):
        law = data.get("law", context.get("law"))
        if not context.get("known", True) or not (law is None or is_law(law)):
            data = {key: value for key, value in data.items() if key in Contact.model_fields}
        elif (table := contact_class(law, map(str, data))) is not Contact:
            return table.model_validate(data, context=info.context)
    made: Contact = handler(data)
    return made


AnyContact = Annotated[SerializeAsAny[Contact], WrapValidator(_of_its_law)]
