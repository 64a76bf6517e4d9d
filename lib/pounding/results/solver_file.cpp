#include <pounding/results/parts_file.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace pounding {
namespace {

using namespace hdf5;

// Names of structures are those of groups elsewhere in the file.
void write_reduction(hid_t solver, const Results& results) {
  const Handle reduction = group(solver, "reduction");
  attribute(reduction, "deeper", std::to_string(results.deeper));
  for (const ReducedStructure& s : results.reduced) {
    const Handle place = group(reduction, s.name);
    scalar(place, {"coordinates", "1", "coordinates of the structure"}, static_cast<long>(s.coordinates));
    integers(place, {"blocks", "1", "blocks of the chain of the links and of that of the ground"},
             {s.link_blocks, s.ground_blocks}, {2});
    integers(place,
             {"inputs", "1",
              "vectors that drive the chain of the links, those of friction and of devices among them, parts "
              "that yield, and vectors of the ground"},
             {s.links, s.frictions, s.devices, s.parts, s.grounds}, {5});
    scalar(place, {"frequency", "Hz", "of the block at the contact; 0 for none"}, s.frequency);
    scalar(place,
           {"error_force", "1", "three times the estimated error of peak forces of links over the largest force"},
           s.error_force);
    scalar(place, {"error_displacement", "1", "the same of displacements of floors"}, s.error_displacement);
    scalar(place, {"error_acceleration", "1", "the same of accelerations of floors"}, s.error_acceleration);
    scalar(place, {"error_members", "1", "the same of forces and moments of members"}, s.error_members);
    if (s.checked_windows == 0) continue;
    scalar(place, {"checked_windows", "1", "hardest impacts through which all unknowns were stepped"},
           static_cast<long>(s.checked_windows));
    scalar(place,
           {"check_force", "1",
            "difference of peak forces of links in them over the largest force; NaN where none hits the structure"},
           s.check_force);
    scalar(place, {"check_displacement", "1", "the same of displacements of floors"}, s.check_displacement);
  }
}

}  // namespace

void write_solver(hid_t file, const Results& results) {
  const SolverStatistics& solver = results.solver;
  const Handle place = group(file, "solver");
  attribute(place, "integrator", results.integrator);
  attribute(place, "options", fmt::format("{}", fmt::join(results.options, " ")));
  scalar(place, {"steps", "1", "steps kept"}, solver.steps);
  scalar(place, {"rejected", "1", "steps thrown away by the error control"}, solver.rejected);
  scalar(place, {"events", "1", "located touches, reversals, releases and separations"}, solver.events);
  scalar(place, {"iterations", "1", "iterations of the link equations"}, solver.iterations);
  scalar(place, {"wall_seconds", "s", "wall time"}, solver.wall_seconds);
  scalar(place, {"wall_setup", "s", "wall time before the first step"}, solver.wall_setup);
  scalar(place, {"wall_solve", "s", "wall time of the steps"}, solver.wall_solve);
  scalar(place, {"wall_output", "s", "wall time of recording and writing"}, solver.wall_output);
  if (!results.reduced.empty()) write_reduction(place, results);
}

}  // namespace pounding
