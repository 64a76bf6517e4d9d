"""Studies: many runs of one model, and the table of their results.

Inputs: reading.py keys, quantities and texts of study files; factors.py varied quantities, gap_factors.py gaps of drawn
frames; distributions.py; sampling.py points of the factors; sources.py ground motions; motions.py intensity measures;
scaling.py and target_spectra.py suites scaled to spectra; quantities.py, structure_values.py and functions.py columns.

Plan: plan.py all rows of a study; plan_checks.py its checks and warnings; template.py the part that workers need, with
values of a row in the model and models read once; files.py contents of files.

Execution: execution.py chunks on an executor; batches.py rows of a worker and their results; engines.py the engines;
kernel_engine.py and pairs.py the compiled kernel; progress.py.

Table: table.py the HDF5 file, resumption and merging; parts.py chunks of a running study; rows.py and study_table.py
its columns, pictures and exports.

Results: study.py `pounding.study` and `pounding.sweep`; suite.py `pounding.suite`; fragility.py, percentiles.py,
gaps.py, separation.py, pictures.py and export.py read tables only; command.py and study_commands.py the commands."""
