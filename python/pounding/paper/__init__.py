"""The page that `pounding reproduce` writes. Private; `pounding.reproduce` is the door."""
