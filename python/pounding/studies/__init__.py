"""Studies: one model run many times, with a table of what came out.

words.py      the words of a study file, quantities with units, and errors that say what to type
factors.py    what is varied: paths into the model, lists, ranges and distributions
sampling.py   points of the factors: grids, Sobol sequences, Latin hypercubes
sources.py    where ground motions come from; record_sets.py those of packages
motions.py    their intensity measures, and how they are scaled
template.py   what a worker needs of a plan
plan.py       all rows, fixed by file, records and seed before anything runs
places.py     where the values of a row go, for many rows at once; prepared.py a model that is read once
batches.py    some rows for a worker, and what came out
engines.py    rows -> columns; the seam where another engine plugs in
kernel_engine.py  linear structures by the compiled kernel; pairs.py two oscillators as columns, kernel_columns.py
its numbers cross_check.py    rows that both engines run worker.py     what runs in a process of its own
execution.py  chunks of rows on an executor; a worker that dies costs its row table.py      the HDF5 file, resume
and merge; parts.py finished chunks while the study runs rows.py       the table as its readers see it study.py
`pounding.study`, `pounding.sweep` and the object that both return readings      fragility.py, percentiles.py,
gaps.py, separation.py, indices.py, pictures.py, export.py: from the table alone command.py    `pounding study`,
`pounding separation`
"""
