"""The page that `pounding reproduce` writes. Private; use `pounding._reproduce`."""
