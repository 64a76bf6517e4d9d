#include <pounding/run/restart.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string_view>

#include <fmt/format.h>

#include <pounding/core/checksum.hpp>
#include <pounding/core/error.hpp>
#include <pounding/core/text.hpp>
#include <pounding/core/version.hpp>
#include <pounding/input/input.hpp>
#include <pounding/input/resolved.hpp>
#include <pounding/model/ground_plan.hpp>
#include <pounding/model/model.hpp>
#include <pounding/petsc/library_lock.hpp>
#include <pounding/results/hdf5.hpp>
#include <pounding/results/results.hpp>

namespace pounding {
namespace {

using hdf5::without_links_group;

// Options that only print or draw, and the limit on steps, do not affect the steps.
bool result_depends_on(const std::string& option) {
  const std::string name = option.substr(0, option.find(' '));
  return name.find("monitor") == std::string::npos && name.find("view") == std::string::npos &&
         name != "-pounding_ts_max_steps";
}

std::vector<std::string> deciding(std::vector<std::string> options) {
  std::erase_if(options, [](const std::string& option) { return !result_depends_on(option); });
  return options;
}

// Checksum of the samples of all records; closed forms are in resolved.yaml.
std::string checksum_of_ground(const GroundPlan& ground) {
  Checksum checksum;
  bool any = false;
  for (const GroundMotion& motion : ground.motions) {
    const Samples* samples = motion.samples();
    if (!samples) continue;
    any = true;
    checksum.add(samples->times);
    checksum.add(samples->accelerations);
  }
  return any ? checksum.text() : "";
}

// First line in which two texts differ, counted from 1.
std::size_t first_different_line(const std::string& a, const std::string& b) {
  const auto difference = std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first;
  return static_cast<std::size_t>(std::count(a.begin(), difference, '\n')) + 1;
}

std::string shown(const std::vector<std::string>& options) {
  return options.empty() ? "no time-stepping options" : fmt::format("{}", fmt::join(options, " "));
}

[[noreturn]] void refuse_damaged(const std::string& file, const std::string& what) {
  throw InputError(fmt::format("{}: the file is damaged ({}); run the model from the start", file, what));
}

void read(hid_t file, InterruptedRun& run) {
  const std::string version = hdf5::read_attribute(file, "version"), status = hdf5::read_attribute(file, "status");
  if (hdf5::read_attribute(file, "program") != "pounding")
    throw InputError(fmt::format("{}: this file was not written by pounding", run.file));
  if (version != POUNDING_VERSION)
    throw InputError(fmt::format(
        "{}: written by pounding {}, this is {}; only the same version can resume it. Run the model from the start",
        run.file, version, POUNDING_VERSION));
  if (status.starts_with("done")) throw InputError(fmt::format("{}: the run is done and cannot be resumed", run.file));
  const bool has_other_run = hdf5::has(file, without_links_group);
  const std::string of_other_run = std::string(without_links_group) + "/checkpoint";
  run.without_links = !hdf5::has(file, "checkpoint") && has_other_run && hdf5::has(file, of_other_run.c_str());
  if (!hdf5::has(file, "checkpoint") && !run.without_links)
    throw InputError(
        fmt::format("{}: no checkpoint in this file (status: {}); run the model from the start", run.file, status));
  const std::string group = run.without_links ? of_other_run : "checkpoint";
  const hdf5::Handle place(H5Gopen2(file, group.c_str(), H5P_DEFAULT), H5Gclose, "open group checkpoint");
  Checkpoint& checkpoint = run.checkpoint;
  run.model_yaml = hdf5::read_text(file, "input/model.yaml");
  run.resolved_yaml = hdf5::read_text(file, "input/resolved.yaml");
  if (has_other_run && !run.without_links) {
    const std::shared_ptr<const hdf5::Handle> copy(new hdf5::Handle(hdf5::memory_file()), [](const hdf5::Handle* made) {
      const LibraryLock lock;
      delete made;
    });
    hdf5::copy_group(file, *copy, without_links_group);
    run.add_no_pounding = [copy](hid_t to) { hdf5::copy_group(*copy, to, without_links_group); };
  }
  checkpoint.ground = hdf5::read_attribute(place, "ground");
  checkpoint.model_file = hdf5::read_text(place, "model_file");
  const std::string options = hdf5::read_text(place, "options");
  for (const std::string_view option : parts_between(options, "\n")) checkpoint.options.emplace_back(option);
  hdf5::read_bytes(place, "state", checkpoint.state);
  const std::string reduction =
      run.without_links ? std::string(without_links_group) + "/solver/reduction" : "solver/reduction";
  if (hdf5::has(file, reduction.c_str())) {
    const hdf5::Handle of_reduction(H5Gopen2(file, reduction.c_str(), H5P_DEFAULT), H5Gclose, "open group reduction");
    run.deeper = std::stoi(hdf5::read_attribute(of_reduction, "deeper"));
  }
}

}  // namespace

Checkpoint checkpoint_of(const Model& model, const std::vector<std::string>& options) {
  const std::string& file = model.source_file;
  return {file.empty() ? "" : std::filesystem::absolute(file).string(),
          deciding(options),
          checksum_of_ground(ground_plan(model)),
          {}};
}

InterruptedRun read_interrupted_run(const std::string& file) {
  if (!std::filesystem::exists(file)) throw InputError(fmt::format("{}: no such file", file));
  InterruptedRun run{.file = file};
  try {
    hdf5::open_file(file, [&](hid_t open) { read(open, run); });
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw InputError(fmt::format("{}: not a results file, or a damaged one ({})", file, error.what()));
  }
  return run;
}

Input input_of(const InterruptedRun& run) {
  const std::string& file = run.checkpoint.model_file;
  if (run.model_yaml == built_by_code)
    throw InputError(
        fmt::format("{}: the model was built by a program; resume it there by run(model, {{.resume = \"{}\"}})",
                    run.file, run.file));
  return Input::read_text(run.model_yaml, file.empty() ? "model.yaml" : file);
}

void add_earlier_options(const InterruptedRun& run, std::vector<std::string>& options) {
  const std::vector<std::string> typed = options;
  for (const std::string& option : run.checkpoint.options) {
    const std::size_t space = option.find(' ');
    const std::string name = option.substr(0, space);
    if (std::find(typed.begin(), typed.end(), name) != typed.end()) continue;
    options.push_back(name);
    if (space != std::string::npos) options.push_back(option.substr(space + 1));
  }
}

void check_same_run(const InterruptedRun& run, const Model& model, const std::vector<std::string>& options) {
  if (model.source_text != run.model_yaml)
    throw InputError(
        fmt::format("{}: run of another model, {} differs from line {} on; resume with the model in the file, or run "
                    "the new one from the start",
                    run.file, model.source_file, first_different_line(run.model_yaml, model.source_text)));
  if (const std::string resolved = resolved_yaml(model);
      model.source_text == built_by_code && resolved != run.resolved_yaml)
    throw InputError(
        fmt::format("{}: run of another model, whose resolved.yaml differs from line {} on; resume with the same "
                    "model, or run the new one from the start",
                    run.file, first_different_line(run.resolved_yaml, resolved)));
  const Checkpoint now = checkpoint_of(model, options);
  if (now.ground != run.checkpoint.ground || resolved_yaml(model) != run.resolved_yaml)
    throw InputError(
        fmt::format("{}: the ground motion of {} differs from that of the interrupted run; restore the earlier record, "
                    "or run the model from the start",
                    run.file, model.source_file));
  if (now.options != run.checkpoint.options)
    throw InputError(
        fmt::format("{}: options differ from the interrupted run ({} then, {} now); resume with the original options",
                    run.file, shown(run.checkpoint.options), shown(now.options)));
}

void read_histories(const InterruptedRun& run, Results& results) {
  try {
    hdf5::open_file(run.file, [&](hid_t file) {
      visit_histories(results, [&](const std::string& place, std::vector<double>& values) {
        hdf5::read_array(file, (run.without_links ? std::string(without_links_group) + '/' + place : place).c_str(),
                         values);
      });
    });
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& error) {
    refuse_damaged(run.file, error.what());
  }
}

}  // namespace pounding
