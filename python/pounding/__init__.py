"""Results of `pounding` as numpy arrays and pictures.

    from pounding.results import read
    from pounding.plots import standard_figure

    run = read("demo.h5")
    run.impacts["restitution"]
    standard_figure(run).savefig("demo.pdf")

Pictures of the model, profiles, animations, mode shapes and exports have a module each: model_picture, profiles,
animation, mode_shapes, export. `python3 -m pounding animate RESULTS.h5 -o FILE.gif` and so on run them from a shell.
"""
