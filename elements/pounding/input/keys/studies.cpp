#include <pounding/input/keys/studies.hpp>

namespace pounding::keys {
// Named, since a unity build puts tables with equal names of keys into one file.
namespace study_tables {

constexpr Key file_keys[] = {
    {"study", map(study), required, "The study of the model. A file with this key runs with pounding study.",
     "{factors: {gap: {of: links.*.gap, list: [10 mm, 20 mm]}}}", since},
    {"model", text(), otherwise("the sections of the model in the same file"),
     "File of the model, relative to the file of the study.", "pair.yaml", since},
    {"title", text(), otherwise("no title"), "Title of the study.", "Gaps of two oscillators", since},
};

constexpr std::string_view grid[] = {"grid"};
constexpr std::string_view engines[] = {"auto", "kernel", "solver"};
constexpr Key study_keys[] = {
    {"seed", integer(bounds::non_negative), otherwise("1"),
     "Seed of all random numbers. The same seed gives the same rows on every machine.", "1", since},
    {"factors", map(factor).named(), otherwise("none"),
     "Quantities that the study varies, by name. Each is a column of the table.",
     "{gap: {of: links.*.gap, list: [10 mm, 20 mm]}}", since},
    {"sampling", choice(grid, "sampling method").or_map(sampling), otherwise("grid"),
     "Sampling method of factors with distributions. Factors with lists and ranges form a grid; the samples are the "
     "same at every grid point.",
     "{sobol: 128}", since},
    {"records", map(records), otherwise("the ground motion of the model"),
     "Ground motions that replace the source of the model's ground motion, one per row.", "{files: records/*.AT2}",
     since},
    {"intensity", map(intensity), otherwise("motions as recorded"),
     "Intensity measure of the motions, and the levels to which they are scaled.",
     "{measure: pga, levels: [0.1 g, 0.2 g]}", since},
    {"keep", text().or_list(), otherwise("displacement, force and impacts; impulse instead of force with rigid links"),
     "Response quantities stored for each row. A suffix selects one structure, floor, member or link: "
     "force.left-right, drift.left.3.",
     "[displacement, force]", since},
    {"without_links", boolean(), otherwise("false"),
     "Also store the response of the structures without links (.alone) and the ratio of both (.ratio).", "true", since},
    {"limits", any_value().named(), otherwise("none"),
     "Limits of response quantities. A row with a value above its limit counts as exceeded.", "{drift: 30 mm}", since},
    {"stop_after", number(bounds::from_0_to_1), otherwise("5 %"), "Fraction of failed rows that stops the study.",
     "5 %", since},
    {"engine", choice(engines, "engine"), otherwise("auto"),
     "auto uses the kernel for linear structures where possible, else the solver.", "auto", since},
    {"separation", map(separation), otherwise("all codes, with displacements as computed"),
     "Codes and their inputs, for pounding separation only.", "{codes: [EN 1998-1], property: line}", since},
};

constexpr std::string_view spacings[] = {"even", "log"};
constexpr Key factor_keys[] = {
    {"of", text().or_list(), otherwise("none, of a factor with a column: the results contain it"),
     "Path or paths in the model that take the value. * is every link or structure; links are selected by name, or by "
     "index from 0. gaps.left-right is the gap between two drawn frames, which moves one of them.",
     "links.*.gap", since},
    {"times", text(), otherwise("none"),
     "Path of a number in the model. The value of the factor is then a ratio to that number.",
     "structures.left.oscillator.period", since},
    {"list", any_value().nonempty_list(), exactly_one,
     "Values: quantities of one unit, or names, such as names of laws.", "[10 mm, 20 mm]", since},
    {"alternatives", any_value().named(), exactly_one,
     "Named maps, each of which replaces the whole map at the path, such as types of isolators or contact laws with "
     "their parameters.",
     "{stiff: {law: linear_spring, stiffness: 2e9}, soft: {law: linear_spring, stiffness: 2e8}}", "0.3.0"},
    {"from", any_value(), exactly_one, "First value of a range; needs to and count.", "0.3", since},
    {"to", any_value(), optional, "Last value of a range.", "1.5", since},
    {"count", integer(2, 1e6), optional, "Number of values in a range, including both ends.", "25", since},
    {"spacing", choice(spacings, "spacing"), otherwise("even"),
     "Spacing of the values in a range; log needs positive ends.", "log", since},
    {"column", text(), exactly_one, "Column of the table of samples that contains the values.", "gap", since},
    {"uniform", map(uniform), exactly_one, "Uniform distribution.", "{from: 10 mm, to: 40 mm}", since},
    {"normal", map(normal), exactly_one, "Normal distribution.", "{mean: 5 %, sd: 1 %}", since},
    {"lognormal", map(lognormal), exactly_one, "Lognormal distribution.", "{median: 2.75e9, cov: 0.3}", since},
    {"triangular", map(triangular), exactly_one, "Triangular distribution.", "{from: 10 mm, mode: 20 mm, to: 40 mm}",
     since},
    {"discrete", map(discrete), exactly_one, "Discrete distribution.",
     "{values: [10 mm, 20 mm], probabilities: [0.3, 0.7]}", since},
    {"scipy", any_value().named(), exactly_one,
     "Continuous distribution of scipy.stats: its name and its parameters in SI.", "{name: gamma, a: 2, scale: 0.01}",
     since},
    {"truncate", any_value().list(2), otherwise("no truncation"), "Lower and upper limit of a distribution.",
     "[15 mm, 30 mm]", since},
};

constexpr Key value_key(std::string_view key, std::string_view meaning, std::string_view example) {
  return Key(key, any_value(), required, meaning, example, since);
}
constexpr Key ratio_key(std::string_view key, Bounds bounds, std::string_view meaning, std::string_view example) {
  return Key(key, number(bounds), exactly_one, meaning, example, since);
}

constexpr Key from_key = value_key("from", "Lower limit.", "10 mm"), to_key = value_key("to", "Upper limit.", "40 mm");
constexpr Key uniform_keys[] = {from_key, to_key};
constexpr Key normal_keys[] = {
    value_key("mean", "Mean.", "20 mm"),
    {"sd", any_value(), exactly_one, "Standard deviation, in the unit of the mean.", "4 mm", since},
    ratio_key("cov", bounds::positive, "Coefficient of variation.", "0.2"),
};
constexpr Key lognormal_keys[] = {
    value_key("median", "Median.", "20 mm"),
    ratio_key("cov", {.low = 0, .high = 1e6, .without_low = true}, "Coefficient of variation.", "0.3"),
    ratio_key("beta", bounds::positive, "Standard deviation of the natural logarithm.", "0.4"),
};
constexpr Key triangular_keys[] = {
    from_key,
    value_key("mode", "Most likely value.", "20 mm"),
    to_key,
};
constexpr Key discrete_keys[] = {
    {"values", any_value().nonempty_list(), required, "Possible values.", "[10 mm, 20 mm]", since},
    {"probabilities", number(bounds::from_0_to_1).nonempty_list(), otherwise("equal probabilities"),
     "Probability of each value; their sum is 1.", "[0.3, 0.7]", since},
};

constexpr Key samples_key(std::string_view key, std::string_view meaning) {
  return Key(key, integer(1, 1e7), exactly_one, meaning, "128", since);
}
constexpr Key sampling_keys[] = {
    samples_key("sobol", "Number of points of a scrambled Sobol sequence, a power of two."),
    samples_key("latin_hypercube", "Number of points of a Latin hypercube."),
    samples_key("random", "Number of independent random points."),
    samples_key("saltelli",
                "Base number of points of Saltelli's scheme for Sobol indices, a power of two. Needs SALib."),
    {"table", text(), exactly_one,
     "CSV file with one sample per line; its first line has names and units, as in T1,gap (mm). In Python also a dict "
     "of arrays.",
     "samples.csv", since},
};

constinit const Section study{"study", "study", "A study: the model is run many times.", study_keys};
constinit const Section factor{"factor", "study.factors.NAME",
                               "Factor: the input values that it replaces, and its distribution.", factor_keys};
constinit const Section uniform{"uniform", "study.factors.NAME.uniform", "Uniform distribution.", uniform_keys};
constinit const Section normal{"normal", "study.factors.NAME.normal", "Normal distribution.", normal_keys};
constinit const Section lognormal{"lognormal", "study.factors.NAME.lognormal", "Lognormal distribution.",
                                  lognormal_keys};
constinit const Section triangular{"triangular", "study.factors.NAME.triangular", "Triangular distribution.",
                                   triangular_keys};
constinit const Section discrete{"discrete", "study.factors.NAME.discrete", "Discrete distribution.", discrete_keys};
constinit const Section sampling{"sampling", "study.sampling", "Sampling method and number of samples.", sampling_keys};
}  // namespace study_tables

constinit const Section study_file{"study_file", "",
                                   "The file of a study: its keys next to those of the model, or with model.",
                                   study_tables::file_keys};

std::span<const Section* const> sections_of_studies() noexcept {
  using namespace study_tables;
  static constexpr const Section* all[] = {
      &study_file, &study,           &factor,          &uniform,      &normal,        &lognormal,
      &triangular, &discrete,        &sampling,        &records,      &files_by_axis, &files_of_axis,
      &artificial, &intensity,       &separation,      &behaviour,    &suite_file,    &suite_records,
      &scale_to,   &target_spectrum, &en1998_spectrum, &asce_spectrum};
  return all;
}

}  // namespace pounding::keys
