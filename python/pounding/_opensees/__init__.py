"""Conversion of OpenSeesPy models and the process of a link. Private; use `pounding.opensees`."""
