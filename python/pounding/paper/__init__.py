"""The page that `pounding reproduce` writes. Private; use `pounding.reproduce`."""
