"""Pictures of runs: their panels, and the model at rest and in motion. Private; `pounding.plots` and others are the
doors."""
