"""Results of `pounding` as numpy arrays and pictures.

    from pounding.results import read
    from pounding.plots import standard_figure

    run = read("demo.h5")
    run.impacts["restitution"]
    standard_figure(run).savefig("demo.pdf")
"""
