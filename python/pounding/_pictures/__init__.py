"""Pictures of runs: panels, and the model at rest and in motion. Private; use `pounding._plots` and `Run.plot`."""
