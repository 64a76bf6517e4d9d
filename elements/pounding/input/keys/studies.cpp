#include <pounding/input/keys/studies.hpp>

namespace pounding::keys {
// Named, because a unity build puts tables with the same names of words into one file.
namespace study_tables {

constexpr Key file_keys[] = {{.key = "study",
                              .inside = &study,
                              .need = Need::required,
                              .since = since,
                              .meaning = "The study of the model. A file with this key runs with pounding study.",
                              .example = "{factors: {gap: {of: links.*.gap, list: [10 mm, 20 mm]}}}"},
                             {.key = "model",
                              .takes = Takes::text,
                              .otherwise = "the sections of the model in the same file",
                              .since = since,
                              .meaning = "File of the model, relative to the file of the study.",
                              .example = "pair.yaml"},
                             {.key = "title",
                              .takes = Takes::text,
                              .otherwise = "no title",
                              .since = since,
                              .meaning = "Title of the study.",
                              .example = "Gaps of two oscillators"}};

constexpr std::string_view grid[] = {"grid"};
constexpr std::string_view engines[] = {"auto", "kernel", "solver"};
constexpr Key study_keys[] = {
    {.key = "seed",
     .takes = Takes::integer,
     .bounds = bounds::non_negative,
     .otherwise = "1",
     .since = since,
     .meaning = "Seed of all random numbers. The same seed gives the same rows on every machine.",
     .example = "1"},
    {.key = "factors",
     .form = Form::named,
     .inside = &factor,
     .otherwise = "none",
     .since = since,
     .meaning = "Quantities that the study varies, by name. Each is a column of the table.",
     .example = "{gap: {of: links.*.gap, list: [10 mm, 20 mm]}}"},
    {.key = "sampling",
     .takes = Takes::choice,
     .inside = &sampling,
     .choices = grid,
     .noun = "sampling method",
     .otherwise = "grid",
     .since = since,
     .meaning =
         "Sampling method of factors with distributions. Factors with lists and ranges form a grid; the samples are "
         "the same at every grid point.",
     .example = "{sobol: 128}"},
    {.key = "records",
     .inside = &records,
     .otherwise = "the ground motion of the model",
     .since = since,
     .meaning = "Ground motions that replace the source of the model's ground motion, one per row.",
     .example = "{files: records/*.AT2}"},
    {.key = "intensity",
     .inside = &intensity,
     .otherwise = "motions as recorded",
     .since = since,
     .meaning = "Intensity measure of the motions, and the levels to which they are scaled.",
     .example = "{measure: pga, levels: [0.1 g, 0.2 g]}"},
    {.key = "keep",
     .takes = Takes::text,
     .form = Form::one_or_list,
     .otherwise = "displacement, force and impacts; impulse instead of force with rigid links",
     .since = since,
     .meaning = "Response quantities stored for each row. A suffix selects one structure or link: force.left-right.",
     .example = "[displacement, force]"},
    {.key = "without_links",
     .takes = Takes::boolean,
     .otherwise = "false",
     .since = since,
     .meaning = "Also store the response of the structures without links (.alone) and the ratio of both (.ratio).",
     .example = "true"},
    {.key = "limits",
     .takes = Takes::value,
     .form = Form::named,
     .otherwise = "none",
     .since = since,
     .meaning = "Limits of response quantities. A row with a value above its limit counts as exceeded.",
     .example = "{drift: 30 mm}"},
    {.key = "stop_after",
     .takes = Takes::quantity,
     .bounds = bounds::from_0_to_1,
     .otherwise = "5 %",
     .since = since,
     .meaning = "Fraction of failed rows that stops the study.",
     .example = "5 %"},
    {.key = "engine",
     .takes = Takes::choice,
     .choices = engines,
     .noun = "engine",
     .otherwise = "auto",
     .since = since,
     .meaning = "auto runs a row with the kernel of linear structures if it can, else with the solver.",
     .example = "auto"}};

constexpr std::string_view spacings[] = {"even", "log"};
constexpr Key factor_keys[] = {
    {.key = "of",
     .takes = Takes::text,
     .form = Form::one_or_list,
     .otherwise = "none, of a factor with a column: the results contain it",
     .since = since,
     .meaning =
         "Path or paths in the model that take the value. * is every link or structure; links are selected by name, "
         "or by index from 0.",
     .example = "links.*.gap"},
    {.key = "times",
     .takes = Takes::text,
     .otherwise = "none",
     .since = since,
     .meaning = "Path of a number in the model. The value of the factor is then a ratio to that number.",
     .example = "structures.left.oscillator.period"},
    {.key = "list",
     .takes = Takes::value,
     .form = Form::list,
     .minimum = 1,
     .need = Need::exactly_one,
     .since = since,
     .meaning = "Values: quantities of one unit, or names, such as names of laws.",
     .example = "[10 mm, 20 mm]"},
    {.key = "from",
     .takes = Takes::value,
     .need = Need::exactly_one,
     .since = since,
     .meaning = "First value of a range; needs to and count.",
     .example = "0.3"},
    {.key = "to", .takes = Takes::value, .since = since, .meaning = "Last value of a range.", .example = "1.5"},
    {.key = "count",
     .takes = Takes::integer,
     .bounds = {.low = 2, .high = 1e6},
     .since = since,
     .meaning = "Number of values in a range, including both ends.",
     .example = "25"},
    {.key = "spacing",
     .takes = Takes::choice,
     .choices = spacings,
     .noun = "spacing",
     .otherwise = "even",
     .since = since,
     .meaning = "Spacing of the values in a range; log needs positive ends.",
     .example = "log"},
    {.key = "column",
     .takes = Takes::text,
     .need = Need::exactly_one,
     .since = since,
     .meaning = "Column of the table of samples that contains the values.",
     .example = "gap"},
    {.key = "uniform",
     .inside = &uniform,
     .need = Need::exactly_one,
     .since = since,
     .meaning = "Uniform distribution.",
     .example = "{from: 10 mm, to: 40 mm}"},
    {.key = "normal",
     .inside = &normal,
     .need = Need::exactly_one,
     .since = since,
     .meaning = "Normal distribution.",
     .example = "{mean: 5 %, sd: 1 %}"},
    {.key = "lognormal",
     .inside = &lognormal,
     .need = Need::exactly_one,
     .since = since,
     .meaning = "Lognormal distribution.",
     .example = "{median: 2.75e9, cov: 0.3}"},
    {.key = "triangular",
     .inside = &triangular,
     .need = Need::exactly_one,
     .since = since,
     .meaning = "Triangular distribution.",
     .example = "{from: 10 mm, mode: 20 mm, to: 40 mm}"},
    {.key = "discrete",
     .inside = &discrete,
     .need = Need::exactly_one,
     .since = since,
     .meaning = "Discrete distribution.",
     .example = "{values: [10 mm, 20 mm], probabilities: [0.3, 0.7]}"},
    {.key = "scipy",
     .takes = Takes::value,
     .form = Form::named,
     .need = Need::exactly_one,
     .since = since,
     .meaning = "Continuous distribution of scipy.stats: its name and its parameters in SI.",
     .example = "{name: gamma, a: 2, scale: 0.01}"},
    {.key = "truncate",
     .takes = Takes::value,
     .form = Form::list,
     .minimum = 2,
     .maximum = 2,
     .otherwise = "no truncation",
     .since = since,
     .meaning = "Lower and upper limit of a distribution.",
     .example = "[15 mm, 30 mm]"}};

constexpr Key value_key(std::string_view key, std::string_view meaning, std::string_view example) {
  return {.key = key,
          .takes = Takes::value,
          .need = Need::required,
          .since = since,
          .meaning = meaning,
          .example = example};
}
constexpr Key ratio_key(std::string_view key, Bounds bounds, std::string_view meaning, std::string_view example) {
  return {.key = key,
          .takes = Takes::quantity,
          .bounds = bounds,
          .need = Need::exactly_one,
          .since = since,
          .meaning = meaning,
          .example = example};
}

constexpr Key from_key = value_key("from", "Lower limit.", "10 mm"), to_key = value_key("to", "Upper limit.", "40 mm");
constexpr Key uniform_keys[] = {from_key, to_key};
constexpr Key normal_keys[] = {value_key("mean", "Mean.", "20 mm"),
                               {.key = "sd",
                                .takes = Takes::value,
                                .need = Need::exactly_one,
                                .since = since,
                                .meaning = "Standard deviation, in the unit of the mean.",
                                .example = "4 mm"},
                               ratio_key("cov", bounds::positive, "Coefficient of variation.", "0.2")};
constexpr Key lognormal_keys[] = {
    value_key("median", "Median.", "20 mm"),
    ratio_key("cov", {.low = 0, .high = 1e6, .without_low = true}, "Coefficient of variation.", "0.3"),
    ratio_key("beta", bounds::positive, "Standard deviation of the natural logarithm.", "0.4")};
constexpr Key triangular_keys[] = {from_key, value_key("mode", "Most likely value.", "20 mm"), to_key};
constexpr Key discrete_keys[] = {{.key = "values",
                                  .takes = Takes::value,
                                  .form = Form::list,
                                  .minimum = 1,
                                  .need = Need::required,
                                  .since = since,
                                  .meaning = "Possible values.",
                                  .example = "[10 mm, 20 mm]"},
                                 {.key = "probabilities",
                                  .takes = Takes::quantity,
                                  .form = Form::list,
                                  .minimum = 1,
                                  .bounds = bounds::from_0_to_1,
                                  .otherwise = "equal probabilities",
                                  .since = since,
                                  .meaning = "Probability of each value; their sum is 1.",
                                  .example = "[0.3, 0.7]"}};

constexpr Key samples_key(std::string_view key, std::string_view meaning) {
  return {.key = key,
          .takes = Takes::integer,
          .bounds = {.low = 1, .high = 1e7},
          .need = Need::exactly_one,
          .since = since,
          .meaning = meaning,
          .example = "128"};
}
constexpr Key sampling_keys[] = {
    samples_key("sobol", "Number of points of a scrambled Sobol sequence, a power of two."),
    samples_key("latin_hypercube", "Number of points of a Latin hypercube."),
    samples_key("random", "Number of independent random points."),
    samples_key("saltelli",
                "Base number of points of Saltelli's scheme for Sobol indices, a power of two. Needs SALib."),
    {.key = "table",
     .takes = Takes::text,
     .need = Need::exactly_one,
     .since = since,
     .meaning =
         "CSV file with one sample per line; its first line has names and units, as in T1,gap (mm). In Python also "
         "a dict of arrays.",
     .example = "samples.csv"}};

constinit const Section study{
    .name = "study", .place = "study", .meaning = "A study: the model is run many times.", .keys = study_keys};
constinit const Section factor{.name = "factor",
                               .place = "study.factors.NAME",
                               .meaning = "One factor: where its values go, and what they are.",
                               .keys = factor_keys};
constinit const Section uniform{
    .name = "uniform", .place = "study.factors.NAME.uniform", .meaning = "Uniform distribution.", .keys = uniform_keys};
constinit const Section normal{
    .name = "normal", .place = "study.factors.NAME.normal", .meaning = "Normal distribution.", .keys = normal_keys};
constinit const Section lognormal{.name = "lognormal",
                                  .place = "study.factors.NAME.lognormal",
                                  .meaning = "Lognormal distribution.",
                                  .keys = lognormal_keys};
constinit const Section triangular{.name = "triangular",
                                   .place = "study.factors.NAME.triangular",
                                   .meaning = "Triangular distribution.",
                                   .keys = triangular_keys};
constinit const Section discrete{.name = "discrete",
                                 .place = "study.factors.NAME.discrete",
                                 .meaning = "Discrete distribution.",
                                 .keys = discrete_keys};
constinit const Section sampling{.name = "sampling",
                                 .place = "study.sampling",
                                 .meaning = "Sampling method and number of samples.",
                                 .keys = sampling_keys};
}  // namespace study_tables

constinit const Section study_file{
    .name = "study_file",
    .place = "",
    .meaning = "The file of a study: its keys next to those of the model, or with model.",
    .keys = study_tables::file_keys};

std::span<const Section* const> sections_of_studies() noexcept {
  using namespace study_tables;
  static constexpr const Section* all[] = {&study_file,    &study,         &factor,     &uniform,  &normal,
                                           &lognormal,     &triangular,    &discrete,   &sampling, &records,
                                           &files_by_axis, &files_of_axis, &artificial, &intensity};
  return all;
}

}  // namespace pounding::keys
