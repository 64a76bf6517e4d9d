#pragma once
/// Results of a run in memory and in one HDF5 file, which h5py reads without help.

#include <array>
#include <functional>
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

/// One end of a link: a structure and its floor, counted from 1 at the lowest; 0 when there is no floor to name.
struct NamedEnd {
  std::string structure;
  int floor = 0;
  std::string label{};  ///< "floor 3", "node b", "10.5 m up"; empty for a wall
};

/// History of one link, dense inside contacts.
struct LinkHistory {
  std::string name;
  std::vector<double> time, penetration, velocity, force, energy;  ///< [s], [m], [m/s], [N], [J]
  int tangents = 0;                                                ///< number of directions in which friction acts
  std::vector<double> friction;                                    ///< row-major [time, tangent] [N]
  double gap = 0;                                                  ///< opening when nothing moves [m]
  std::string law;                                                 ///< name of the contact law
  NamedEnd left, right;  ///< its ends; pictures place the right one a gap away from the left one
  std::array<double, 3> position{}, direction{1, 0, 0};  ///< of the left end [m]; from left to right
};

/// History of a device between two structures at the output times.
struct DeviceHistory {
  std::string name;
  NamedEnd left, right;
  std::array<double, 3> position{}, direction{1, 0, 0};  ///< of the left end [m]; from left to right
  double stiffness = 0;    ///< of the bar, the initial one of a law of yielding [N/m]; 0 for none
  double coefficient = 0;  ///< of the damper [N (s/m)^exponent]; 0 for none
  double exponent = 1;
  std::vector<double> elongation, force;  ///< [m], [N]; positive in tension
  Extremes extremes{2};                   ///< of the two over all steps
};

/// Histories of one structure at the output times, row-major [time, place, direction].
struct StructureHistory {
  std::string name, kind;
  int dimension = 1;
  std::vector<std::string> floors;  ///< labels from the ground up
  std::vector<double> elevations;   ///< of the floors [m]; NaN where not known
  std::vector<double>
      plans;  ///< [floor, 4] extents of rigid floors in space, see Floor::plan [m]; NaN for others, empty for none
  std::vector<std::string> directions{"x"};    ///< of the floors' motion
  std::vector<double> displacement, velocity;  ///< of floors, relative to the ground [m], [m/s], [rad], [rad/s]
  std::vector<double> acceleration;            ///< absolute [m/s^2], [rad/s^2]
  /// Floor minus the floor below [m], and the force of the storey below a floor [N]: [time, floor], in space [time,
  /// floor, x y]. Empty in a structure without storeys.
  std::vector<double> drift, storey_shear;
  std::vector<std::string> nodes, node_directions;
  std::vector<double> node_displacement, node_velocity, node_acceleration;  ///< [time, node, direction]
  std::vector<std::string> members, member_components;
  std::vector<double> end_forces;  ///< [time, member, component] [N], [N m]
  std::vector<double>
      reaction;  ///< [time, support, direction] of the ground on a frame, named in the envelope [N], [N m]
  StructureEnvelope envelope;
  SpringHistory springs;  ///< of the parts that yield
  Geometry geometry;

  /// Number of directions of drift and storey shear.
  int storey_directions() const { return dimension == 3 ? 2 : 1; }
};

/// Energy balance at the output times [s], [J]: input = kinetic + strain + damping + hysteretic + impact + devices +
/// error.
struct EnergyHistory {
  std::vector<double> time, input, kinetic, strain, damping, hysteretic, impact, devices, error;
};

/// Effort of a run.
struct SolverStatistics {
  long steps = 0;           ///< kept steps
  long rejected = 0;        ///< steps rejected by the error control
  long events = 0;          ///< located touches, reversals, releases, separations
  long iterations = 0;      ///< iterations of the link equations
  double wall_seconds = 0;  ///< whole wall time [s]
  double wall_setup = 0, wall_solve = 0,
         wall_output = 0;  ///< its parts: before the first step, in the steps, for output [s]
};

/// Content of a results file.
struct Results {
  std::string program = "pounding", version, created, title, command;
  std::string status = "running";    ///< running | done | done: collapse ... | failed: reason
  std::string model_yaml;            ///< the input as given
  std::string resolved_yaml;         ///< every default and calibrated parameter filled in
  std::string integrator;            ///< scheme of the time stepping by its name in the input
  std::vector<std::string> options;  ///< PETSc options in force: "-pounding_ts_rtol 1e-6"
  std::vector<double> time;          ///< output times [s]
  std::vector<StructureHistory> structures;
  std::vector<LinkHistory> links;
  std::vector<DeviceHistory> devices;
  std::vector<ImpactRow> impacts;
  EnergyHistory energy;
  std::vector<double> ground_acceleration;                           ///< along x at the output times [m/s^2]
  bool shakes_y = false, shakes_z = false;                           ///< the ground also moves along y, along z
  std::vector<double> ground_acceleration_y, ground_acceleration_z;  ///< along y and z; empty if it does not move so
  /// Of a run without links, three a link: displacements of the left and the right end along the link, relative to the
  /// ground, and how far the two have approached each other [m]. Else empty.
  Extremes approach;
  /// File image of the run without links that `compare: no_pounding` asks for; else empty.
  FileImage no_pounding;
  SolverStatistics solver;
  std::vector<ReducedStructure> reduced;  ///< structures in fewer coordinates, with estimated errors
  int deeper = 0;                         ///< blocks of automatic reductions beside those that the tolerance asks for
  std::string summary_json;               ///< the object that --json prints
  /// Whether any device stands between structures, or with a damper inside one.
  bool has_devices() const;
  std::optional<Checkpoint> checkpoint;  ///< of an interrupted run that can be resumed
};

/// Writes the whole file beside `path` and moves it there in one step: whoever opens `path`, also after a kill at any
/// moment, finds a complete earlier or a complete new file. Names of structures and links become group names, so they
/// must differ, must not be empty, "." or "..", and must not contain '/'. Throws InputError when `path` cannot be
/// written or a name is not possible, std::invalid_argument when the lengths of the histories do not fit together,
/// std::runtime_error with HDF5's error text if HDF5 fails.
void write_results(const Results& results, const std::string& path);

/// Bytes of the file that write_results() writes, for readers without a disk; throws as write_results().
FileImage results_image(const Results& results);

/// An image without a checksum, for `Results::no_pounding` of another run.
FileImage image_to_add(const Results& results);

/// Calls `visit` for every history in time, those of links and energies included, with its path in the file and its
/// values.
void visit_histories(Results& results,
                     const std::function<void(const std::string& path, std::vector<double>& values)>& visit);

}  // namespace pounding
