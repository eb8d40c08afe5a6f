"""Runs the notebooks as they are shipped, and with the data of somebody else."""

import os
import pathlib
import sys

import nbformat
from nbconvert.preprocessors import ExecutePreprocessor

import sonoglide

IDENTIFY = pathlib.Path(os.environ["SONOGLIDE_SCENES"]).parent / "studies" / "identify"

# In place of the cell with the tag `parameters`.
OTHER_DATA = {
    "from_figure_2_to_your_contact": [
        f"""
import pandas
readings = pandas.read_csv("{IDENTIFY}/friction/examples/luo_2024.csv", comment="#")
laws = []
""",
        """
readings = {
    "sliding_velocity_m_per_s": [0.01, 0.03, 0.05, 0.07],
    "vibration_velocity_m_per_s": [0.1, 0.1, 0.1, 0.05],
    "friction_force_N": [0.9, 2.6, 4.4, 13.0],
}
laws = ["coulomb", "transverse_coulomb"]
""",
        # A structured array.
        f"""
import pandas
readings = pandas.read_csv("{IDENTIFY}/friction/examples/luo_2024.csv", comment="#").to_records(index=False)
laws = ["dahl", "iwan"]
""",
        # A file with decimal commas.
        """
import pathlib
pathlib.Path("decimal_commas.csv").write_text(
    "# measured on Monday\\nsliding_velocity_m_per_s;vibration_velocity_m_per_s;friction_force_N\\n"
    "0,01;0,1;0,9\\n0,03;0,1;2,6\\n0,05;0,1;4,4\\n0,07;0,05;13,0\\n")
readings = "decimal_commas.csv"
laws = ["coulomb", "dahl"]
""",
    ],
    "tune_a_controller": [
        """
import sonoglide
targets = [[0.0, 0.5], [1.5e-3, 0.45]]
scene = sonoglide.Scene(sonoglide.scenes / "target_step.toml", {"controller.target_friction_ratio": targets})
softest, stiffest = 0.97, 1.02
""",
    ],
    "from_a_sweep_to_a_robust_controller": [
        f"""
sweep = "{IDENTIFY}/impedance/examples/piece_112_kHz.csv"
fact = {{"force_factor_N_per_V": 0.4}}
tolerances = {{}}
""",
    ],
}


def executed(notebook, folder):
    """The notebook with its outputs; raises where a cell fails."""
    ExecutePreprocessor(timeout=600, kernel_name="python3").preprocess(notebook, {"metadata": {"path": str(folder)}})
    return notebook


def check_shipped(path, folder):
    shipped = nbformat.read(path, as_version=4)
    found = executed(nbformat.read(path, as_version=4), folder)
    for mine, theirs in zip(found.cells, shipped.cells):
        if mine.cell_type == "code":
            kinds = [[output.output_type for output in cell.outputs] for cell in (mine, theirs)]
            assert kinds[0] == kinds[1], f"the outputs of a cell are others than shipped: {kinds}\n{mine.source}"


def check_with(path, folder, data):
    notebook = nbformat.read(path, as_version=4)
    (cell,) = [cell for cell in notebook.cells if "parameters" in cell.metadata.get("tags", [])]
    cell.source = data
    executed(notebook, folder)


folder = pathlib.Path("notebooks")
folder.mkdir(exist_ok=True)
path = sonoglide.notebooks / f"{sys.argv[1]}.ipynb"
check_shipped(path, folder)
for data in OTHER_DATA[sys.argv[1]]:
    check_with(path, folder, data)
