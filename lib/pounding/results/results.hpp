#pragma once
/// Results of a run in memory and in one HDF5 file, readable with plain h5py.

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pounding/links/impact_row.hpp>
#include <pounding/model/reduction.hpp>
#include <pounding/results/envelope.hpp>
#include <pounding/results/file_image.hpp>
#include <pounding/results/spring_history.hpp>
#include <pounding/structures/structure.hpp>

namespace pounding {

/// One end of a link: a structure and its floor, counted from 1 at the lowest, or 0.
struct NamedEnd {
  std::string structure;
  int floor = 0;
  std::string label{};  ///< "floor 3", "node b", "10.5 m up"; empty for a wall
};

/// History of one link, densely sampled during contact.
struct LinkHistory {
  std::string name;
  std::vector<double> time, penetration, velocity, force, energy;  ///< [s], [m], [m/s], [N], [J]
  int tangents = 0;                                                ///< number of friction directions
  std::vector<double> friction;                                    ///< row-major [time, tangent] [N]
  double gap = 0;                                                  ///< opening when nothing moves [m]
  double largest_opening = 0, t_opening = 0;                       ///< see LinkSummary [m], [s]
  double seat = 0;                                                 ///< length of the seat [m]; NaN for none
  std::string law;                                                 ///< name of the contact law
  NamedEnd left, right;                                  ///< in pictures, the right end is a gap away from the left one
  std::array<double, 3> position{}, direction{1, 0, 0};  ///< of the left end [m]; from left to right
};

/// History of a device between two structures at the output times.
struct DeviceHistory {
  std::string name;
  NamedEnd left, right;
  std::array<double, 3> position{}, direction{1, 0, 0};  ///< of the left end [m]; from left to right
  double stiffness = 0;                                  ///< of the bar, initial if it yields [N/m]; 0 for none
  double coefficient = 0;                                ///< of the damper [N (s/m)^exponent]; 0 for none
  double exponent = 1;
  std::vector<double> elongation, force;  ///< [m], [N]; positive in tension
  Extremes extremes{2};                   ///< of elongation and force over all steps
};

/// Histories of one structure at the output times, row-major [time, place, direction].
struct StructureHistory {
  std::string name, kind;
  int dimension = 1;
  std::vector<std::string> floors;  ///< labels from the ground up
  std::vector<double> elevations;   ///< of the floors [m]; NaN if unknown
  /// [floor, 4] extents of rigid floors in space, see Floor::plan [m]; NaN for other floors, empty if there are none
  std::vector<double> plans;
  std::vector<std::string> directions{"x"};    ///< of the floor motion
  std::vector<double> displacement, velocity;  ///< of floors, relative to the ground [m], [m/s], [rad], [rad/s]
  std::vector<double> acceleration;            ///< absolute [m/s^2], [rad/s^2]
  /// Displacement relative to the floor below [m], and force of the storey below a floor [N]: [time, floor], in space
  /// [time, floor, x y]. Empty for a structure without storeys.
  std::vector<double> drift, storey_shear;
  std::vector<std::string> nodes, node_directions;
  std::vector<double> node_displacement, node_velocity, node_acceleration;  ///< [time, node, direction]
  std::vector<std::string> members, member_components;
  std::vector<double> end_forces;  ///< [time, member, component] [N], [N m]
  /// [time, support, direction] of the ground on a frame, labelled in the envelope [N], [N m]
  std::vector<double> reaction;
  StructureEnvelope envelope;
  SpringHistory springs;  ///< of the yielding parts
  Geometry geometry;

  /// Number of directions of drift and storey shear.
  int storey_directions() const { return dimension == 3 ? 2 : 1; }
};

/// Energy balance at the output times [s], [J]: input = kinetic + strain + damping + hysteretic + impact + devices +
/// error.
struct EnergyHistory {
  std::vector<double> time, input, kinetic, strain, damping, hysteretic, impact, devices, error;
};

/// Solver effort of a run.
struct SolverStatistics {
  long steps = 0;           ///< accepted steps
  long rejected = 0;        ///< steps rejected by the error control
  long events = 0;          ///< located touches, reversals, releases, separations
  long iterations = 0;      ///< iterations of the link equations
  double wall_seconds = 0;  ///< total wall time [s]
  /// wall time before the first step, in the steps, and for output [s]
  double wall_setup = 0, wall_solve = 0, wall_output = 0;
};

/// Content of a results file.
struct Results {
  std::string program = "pounding", version, created, title, command;
  std::string status = "running";    ///< running | done | done: collapse ... | failed: reason
  std::string model_yaml;            ///< the input as given
  std::string resolved_yaml;         ///< with every default and calibrated parameter
  std::string integrator;            ///< time integration scheme by its name in the input
  std::vector<std::string> options;  ///< PETSc options in effect: "-pounding_ts_rtol 1e-6"
  std::vector<double> time;          ///< output times [s]
  std::vector<StructureHistory> structures;
  std::vector<LinkHistory> links;
  std::vector<DeviceHistory> devices;
  std::vector<ImpactRow> impacts;
  EnergyHistory energy;
  std::vector<double> ground_acceleration;  ///< along x at the output times [m/s^2]
  bool shakes_y = false, shakes_z = false;  ///< true if the ground also moves along y, along z
  std::vector<double> ground_acceleration_y,
      ground_acceleration_z;  ///< along y and z; empty if it does not move in that direction
  /// For a run without links, three quantities per link: displacements of the left and the right end along the link,
  /// relative to the ground, and the approach of the two [m]. Otherwise empty.
  Extremes approach;
  /// Adds the group of the run without links, which `compare: no_pounding` requests, to an open HDF5 file; otherwise
  /// empty.
  std::function<void(std::int64_t file)> add_no_pounding;
  SolverStatistics solver;
  std::vector<ReducedStructure> reduced;  ///< reduced structures, with estimated errors
  int deeper = 0;            ///< extra blocks of automatic reductions beyond those that follow from the tolerance
  std::string summary_json;  ///< the object that --json prints
  /// True if there are devices between structures, or a damper inside one.
  bool has_devices() const;
  std::optional<Checkpoint> checkpoint;  ///< of an interrupted run that can be resumed
};

/// Writes the file atomically: readers of `path` find either the complete earlier file or the complete new one, even
/// after a kill. Names of structures and links become group names. They must differ, must not be empty, "." or "..",
/// and must not contain '/'. Throws InputError if `path` cannot be written or a name is not allowed,
/// std::invalid_argument if the lengths of the histories are inconsistent, and std::runtime_error with HDF5's error
/// text if HDF5 fails.
void write_results(const Results& results, const std::string& path);

/// Bytes of the file that write_results() writes, for use without a disk; throws as write_results().
FileImage results_image(const Results& results);

/// The results of a run without links, for `Results::add_no_pounding` of the run with links.
std::function<void(std::int64_t file)> group_without_links(std::shared_ptr<const Results> results);

/// Calls `visit` for every history in time, including links and energies, with its path in the file and its values.
void visit_histories(Results& results,
                     const std::function<void(const std::string& path, std::vector<double>& values)>& visit);

}  // namespace pounding
