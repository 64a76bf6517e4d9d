// Histories per second of the study kernel, one thread: one JSON object per line.
//
//   studies RECORD.txt [SECONDS [FOLDER]]
//
// RECORD.txt: accelerations [m/s^2] at 0.02 s, one per line; El Centro 1940 from Chopra's book has 1560. 512 pairs of
// oscillators (periods 0.2 to 2 s, gaps to 60 mm, mass ratios 0.5 to 2, 5 %) by every penalty law, and shear buildings
// of five and three storeys with three links, each for SECONDS of processor time (1 by default). FOLDER: pairs
// h_kelvin.txt, h_hertz.txt (per line: both periods, damping ratios, masses, the gap, k, and c or a) and their
// converged peaks reference_kelvin.txt, reference_hertz.txt (both displacements, the force, impacts); the fraction of
// pairs whose displacements and force are within 1e-4 of them is printed with the speed.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <pounding/elements.hpp>
#include <pounding/laws/compiled.hpp>
#include <pounding/study/kernel.hpp>
#include <pounding/study/modal_form.hpp>

namespace {

using namespace pounding;

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// Runs the models repeatedly until the time is over. The first round fills the caches of laws: adams_impact tabulates
// its damping.
nlohmann::json measured(const std::string& name, const std::vector<study::LinearModel>& models,
                        const study::EvenRecord& record, double seconds) {
  for (const study::LinearModel& model : models) study::run(model, record);
  const double start = processor_seconds();
  double histories = 0, steps = 0, impacts = 0, time = 0;
  for (std::size_t i = 0; time < seconds || i < 16; ++i) {
    const study::Peaks peaks = study::run(models[i % models.size()], record);
    ++histories, steps += static_cast<double>(peaks.steps);
    for (const study::LinkPeaks& link : peaks.links) impacts += link.impacts;
    time = processor_seconds() - start;
  }
  return {{"case", name},
          {"histories_per_second", histories / time},
          {"impacts", impacts / histories},
          {"steps_in_contact", steps / histories}};
}

std::vector<study::LinearModel> pairs(const laws::Entry& entry) {
  std::mt19937 engine(7);
  const auto u = [&] { return static_cast<double>(engine()) / 4294967296.0; };
  std::vector<study::LinearModel> models;
  for (int i = 0; i < 512; ++i) {
    const double t1 = 0.2 * std::pow(10, u()), t2 = 0.2 * std::pow(10, u()), gap = 0.06 * u(), m1 = 1e5,
                 m2 = 1e5 * std::pow(4, u() - 0.5);
    laws::Settings settings = laws::typical_settings(entry);
    settings.reduced_mass = m1 * m2 / (m1 + m2);
    models.push_back(study::pair_of({m1, t1, 0.05}, {m2, t2, 0.05}, gap, laws::make_law(settings)));
  }
  return models;
}

study::LinearModel buildings(double gap, const Samples& samples) {
  Model model;
  const auto left = model.add("left", make_shear_building({.storeys = 5, .mass = 2e5, .stiffness = 3e8}),
                              {.damping = ModalDamping{0.05}});
  const auto right = model.add("right", make_shear_building({.storeys = 3, .mass = 3e5, .stiffness = 6e8}),
                               {.damping = ModalDamping{0.05}});
  model.link(left, right, {.gap = gap, .floors = FacingFloors::level},
             laws::HertzDamped{.stiffness = 2.75e9, .damping_factor = 0.793});
  model.ground = GroundMotion(samples);
  model.complete();
  return study::modal_form(model);
}

// Every pair of a file once, compared with its converged peaks.
nlohmann::json compared(const std::string& folder, const std::string& law, const study::EvenRecord& record) {
  std::ifstream file(folder + "/h_" + law + ".txt"), reference(folder + "/reference_" + law + ".txt");
  double t[2], z[2], m[2], gap = 0, k = 0, damping = 0, peaks[4];
  std::vector<study::LinearModel> models;
  while (file >> t[0] >> t[1] >> z[0] >> z[1] >> m[0] >> m[1] >> gap >> k >> damping)
    models.push_back(study::pair_of(
        {m[0], t[0], z[0]}, {m[1], t[1], z[1]}, gap,
        law == "hertz" ? laws::AnyLaw(laws::HertzDamped{.stiffness = k, .damping_factor = damping})
                       : laws::AnyLaw(laws::KelvinVoigt{.stiffness = k, .damping_coefficient = damping})));
  if (models.empty()) throw std::runtime_error("no pairs in " + folder + "/h_" + law + ".txt");
  std::vector<study::Peaks> found;
  const double start = processor_seconds();
  for (const study::LinearModel& model : models) found.push_back(study::run(model, record));
  const double time = processor_seconds() - start;
  double within = 0, count = 0;
  for (const study::Peaks& peak : found) {
    if (!(reference >> peaks[0] >> peaks[1] >> peaks[2] >> peaks[3]))
      throw std::runtime_error("reference_" + law + ".txt is shorter than the pairs");
    const auto near = [](double x, double y) { return std::abs(x - y) <= 1e-4 * std::abs(y); };
    within +=
        near(peak.outputs[0], peaks[0]) && near(peak.outputs[1], peaks[1]) && near(peak.links[0].peak_force, peaks[2]);
    ++count;
  }
  return {{"case", "ensemble, " + law}, {"histories_per_second", count / time}, {"share_within_1e-4", within / count}};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "studies RECORD.txt [SECONDS [FOLDER]]\n";
    return 1;
  }
  Samples samples;
  std::ifstream file(argv[1]);
  for (double a = 0; file >> a;)
    samples.times.push_back(0.02 * static_cast<double>(samples.times.size())), samples.accelerations.push_back(a);
  samples.uniform = true;
  const double seconds = argc > 2 ? std::atof(argv[2]) : 1;
  const study::EvenRecord record{.accelerations = samples.accelerations, .step = 0.02};
  try {
    if (argc > 3)
      for (const char* law : {"kelvin", "hertz"}) std::cout << compared(argv[3], law, record).dump() << std::endl;
    for (const laws::Entry& entry : laws::catalogue())
      if (!entry.instantaneous)
        std::cout << measured(std::string(entry.name), pairs(entry), record, seconds).dump() << std::endl;
    std::vector<study::LinearModel> both;
    for (int i = 0; i < 16; ++i) both.push_back(buildings(0.002 * i, samples));
    std::cout << measured("shear buildings of 5 and 3 storeys", both, record, seconds).dump() << std::endl;
  } catch (const std::exception& error) {
    std::cerr << "studies: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
