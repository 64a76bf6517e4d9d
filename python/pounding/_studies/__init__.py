"""Studies: many runs of one model, and the table of their results.

Inputs: reading.py keys and quantities of study files; factors.py varied quantities; distributions.py; sampling.py
points of the factors; sources.py and record_sets.py ground motions; motions.py intensity measures and scaling.

Plan: plan.py all rows of a study; template.py the part that workers need; places.py values of a row in the model.

Execution: execution.py chunks on an executor; worker.py code of a worker process; batches.py rows of a worker and
their results; prepared.py models read once; engines.py the engines; kernel_engine.py, pairs.py and kernel_columns.py
the compiled kernel; cross_check.py rows run by both engines.

Table: table.py the HDF5 file, resumption and merging; parts.py chunks of a running study; rows.py its columns.

Results: study.py `pounding.study` and `pounding.sweep`; fragility.py, percentiles.py, gaps.py, separation.py,
indices.py, pictures.py and export.py read tables only; command.py `pounding study` and `pounding separation`."""
