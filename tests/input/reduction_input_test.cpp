// The key `reduction`, and its errors.

#include <gtest/gtest.h>

#include <string>

#include <pounding/core/error.hpp>
#include <pounding/input/resolved.hpp>
#include <pounding/model/reducible.hpp>
#include "support/messages.hpp"
#include "support/models.hpp"

namespace pounding {
namespace reduction_input_test {

using test::model_of;

std::string pair(const std::string& reduction, const std::string& own = "",
                 const std::string& law = "hertz, stiffness: 1e9", const std::string& damping = "5 %",
                 const std::string& more = "") {
  const auto frame = [&](const std::string& name, const std::string& origin, const std::string& beside) {
    return "  " + name + ": {frame: {origin: [" + origin +
           "], material: {E: 30 GPa}, grid: {storeys: 3, bays: 1, storey_height: 3 m, bay_width: 6 m, columns: "
           "{circle: 0.5}, beams: {circle: 0.5}, floor_mass: 20 t}" +
           more + "}, damping: " + damping + beside + "}\n";
  };
  return "structures:\n" + frame("left", "0", own) + frame("right", "6.02", "") +
         "links: [{between: [left.3, right.3], gap: 20 mm, law: " + law + "}]\nanalysis: {duration: 1" + reduction +
         "}\n";
}

void refused(const std::string& yaml, const test::Facts& facts,
             std::source_location line = std::source_location::current()) {
  test::expect_message(test::refusal<InputError>([&] { model_of(yaml); }), "test.yaml:", facts, line);
}

TEST(ReductionInput, IsNoneByDefault) {
  const Model model = model_of(pair(""));
  EXPECT_EQ(reduction_of(model, 0).kind, Reduction::Kind::none);
  EXPECT_EQ(resolved_yaml(model).find("reduction"), std::string::npos);
}

TEST(ReductionInput, TakesChoicesAndNumbers) {
  EXPECT_EQ(model_of(pair(", reduction: auto")).analysis.reduction.kind, Reduction::Kind::automatic);
  EXPECT_EQ(model_of(pair(", reduction: all modes")).analysis.reduction.kind, Reduction::Kind::all_modes);
  EXPECT_EQ(model_of(pair(", reduction: none")).analysis.reduction.kind, Reduction::Kind::none);
  const Reduction blocks = model_of(pair(", reduction: {links: 6}")).analysis.reduction;
  EXPECT_EQ(blocks.kind, Reduction::Kind::blocks);
  EXPECT_EQ(blocks.links, 6);
  EXPECT_EQ(blocks.ground, 20);
  const Reduction lowest = model_of(pair(", reduction: {modes: 4}")).analysis.reduction;
  EXPECT_EQ(lowest.kind, Reduction::Kind::lowest);
  EXPECT_EQ(lowest.modes, 4);
  const Reduction bound = model_of(pair(", reduction: {error: 1e-4, of: [members]}")).analysis.reduction;
  EXPECT_EQ(bound.kind, Reduction::Kind::automatic);
  EXPECT_EQ(bound.error, 1e-4);
  EXPECT_TRUE(bound.of_members);
  EXPECT_FALSE(bound.of_acceleration);
  EXPECT_EQ(bound.text(), "{error: 0.0001, of: [members]}");
}

TEST(ReductionInput, TakesACheckWithAndWithoutNumbers) {
  const auto text = [](const std::string& how) {
    return model_of(pair(", reduction: " + how)).analysis.reduction.text();
  };
  EXPECT_EQ(text("{check: true}"), "{check: true}");
  EXPECT_EQ(model_of(pair(", reduction: {check: true}")).analysis.reduction.kind, Reduction::Kind::automatic);
  EXPECT_EQ(text("{links: 3, ground: 7, check: true}"), "{links: 3, ground: 7, check: true}");
  EXPECT_EQ(text("{links: 3, ground: 7, check: false}"), "{links: 3, ground: 7}");
  EXPECT_EQ(text("{error: 1e-4, check: true}"), "{error: 0.0001, check: true}");
  EXPECT_EQ(text("{modes: 4, check: true}"), "{modes: 4, check: true}");
  EXPECT_NE(resolved_yaml(model_of(pair(", reduction: {check: true}"))).find("left: \"{check: true}\""),
            std::string::npos);
  refused(pair(", reduction: {check: often}"), {"analysis.reduction.check"});
  refused(pair(", reduction: {check: false}"), {"reduction: {links: 5, ground: 20}", "reduction: auto"});
}

TEST(ReductionInput, MayDifferForOneStructure) {
  const Model model = model_of(pair(", reduction: auto", ", reduction: {links: 3, ground: 7}"));
  EXPECT_EQ(reduction_of(model, 0).ground, 7);
  EXPECT_EQ(reduction_of(model, 1).kind, Reduction::Kind::automatic);
  EXPECT_NE(resolved_yaml(model).find("reduction:\n    left: \"{links: 3, ground: 7}\"\n    right: auto"),
            std::string::npos)
      << resolved_yaml(model);
}

TEST(ReductionInput, RejectsInvalidSizes) {
  refused(pair(", reduction: often"), {"often", "analysis.reduction"});
  refused(pair(", reduction: {}"), {"reduction: {links: 5, ground: 20}", "reduction: auto"});
  refused(pair(", reduction: {links: 0}"), {"analysis.reduction.links"});
  refused(pair(", reduction: {modes: 5, links: 3}"), {"modes", "blocks"});
  refused(pair(", reduction: {of: [members]}"), {"of: [acceleration]"});
  refused(pair(", reduction: {error: 1e-4, ground: 3}"), {"error", "ground"});
  refused(pair(", reduction: {error: 1e-4, of: [shears]}"), {"shears"});
  refused(pair(", reduction: {shift: 3}"), {"shift"});
}

// The choices skip structures that cannot be reduced; explicit sizes are errors for them.
TEST(ReductionInput, RejectsNumbersForStructuresThatCannotBeReduced) {
  const std::string own = ", reduction: {links: 5, ground: 20}";
  const auto both = [&](const std::string& law, const std::string& damping, const std::string& more,
                        const std::string& message) {
    refused(pair("", own, law, damping, more), {"structures.left.reduction", message});
    EXPECT_NE(why_not_reduced(model_of(pair(", reduction: auto", "", law, damping, more)), 0), "");
  };
  both("stereomechanical, restitution: 0.65", "5 %", "", "left.3-right.3");
  both("hertz, stiffness: 1e9", "5 %", ", geometry: corotational", "corotational");
  EXPECT_EQ(why_not_reduced(model_of(pair("")), 0), "");
  EXPECT_NO_THROW(model_of(pair("", own)));
  EXPECT_NO_THROW(model_of(pair("", own, "hertz, stiffness: 1e9, friction: 0.3")));
  EXPECT_NO_THROW(model_of(pair("", own, "hertz, stiffness: 1e9", "5 %",
                                ", devices: {brace: {between: [\"0.0\", \"1.1\"], bar: {stiffness: 1e7}}}")));
  EXPECT_NO_THROW(model_of(
      pair("", own, "hertz, stiffness: 1e9", "5 %", ", hinges: {columns: {at: both, yield_moment: 200 kN m}}")));
  EXPECT_NO_THROW(model_of(pair("", own) + "devices: {tie: {between: [left.2, right.2], bar: {stiffness: 1e7}}}\n"));
}

// The damping matrix is dense, so it is not formed for thousands of modes if the modes of the reduced structure are
// damped.
TEST(ReductionInput, NeedsNoMatrixOfModalDamping) {
  const auto matrix_of = [](const std::string& reduction, const std::string& own = "") {
    const Model model = model_of(pair(reduction, own, "hertz, stiffness: 1e9", "{modal: {ratio: 5 %}}"));
    EXPECT_EQ(model.structures[0].modal_ratio, 0.05);
    EXPECT_EQ(why_not_reduced(model, 0), "");
    return model.structures[0].modal_damping.size() > 0;
  };
  EXPECT_TRUE(matrix_of(""));
  EXPECT_TRUE(matrix_of(", reduction: auto")) << "auto does not reduce small structures";
  EXPECT_FALSE(matrix_of(", reduction: {links: 2}"));
  EXPECT_FALSE(matrix_of("", ", reduction: {links: 2}"));
}

TEST(ReductionInput, IsWhatModalDampingOfManyModesNeeds) {
  const auto read = [](const std::string& location, const std::string& reduction) {
    const std::string beside = location == "beside" ? ", damping: {modal: {ratio: 5 %}}" : "",
                      inside = location == "inside" ? ", damping: {modal: {ratio: 5 %}}" : "";
    const std::string yaml =
        "structures:\n  a: {frame: {material: {E: 30 GPa}, grid: {storeys: 40, bays: 20, storey_height: 3 m, "
        "bay_width: 6 m, columns: {circle: 0.5}, beams: {circle: 0.5}, floor_mass: 20 t}" +
        inside + "}" + beside + "}\nanalysis: {duration: 1" + reduction + "}\n";
    const ModeSolver quick = [](const SparseMatrix& mass, const SparseMatrix&, int count) {
      return Eigenmodes{Eigen::VectorXd::Ones(count), Eigen::MatrixXd::Zero(mass.rows(), count)};
    };
    return read_model(Input::read_text(yaml, "test.yaml"), quick);
  };
  for (const std::string location : {"beside", "inside"}) try {
      read(location, "");
      ADD_FAILURE() << "a matrix of 1680 modes was formed, damping " << location;
    } catch (const InputError& error) {
      const std::string text = error.what();
      EXPECT_TRUE(test::mentions(text, {"damping: {rayleigh: {ratio: 5 %, modes: [1, 2]}}",
                                        "analysis: {reduction: auto}", "damping.modal", "1680"}));
    }
  EXPECT_EQ(read("beside", ", reduction: auto").structures[0].modal_damping.size(), 0);
  try {
    read("beside", ", reduction: {check: true}");
    ADD_FAILURE() << "the full system with a matrix of 1680 modes was accepted";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_TRUE(test::mentions(text, {"a", "damping: 5 %", "check: false", "analysis.reduction.check", "1680"}));
  }
}

TEST(ReductionInput, RejectsNumbersForWallsAndBodies) {
  const std::string pair =
      "links: [{between: [a, b], gap: 1 mm, law: hertz, stiffness: 1e9}]\nanalysis: {duration: 1}\nstructures:\n";
  refused(pair + "  a: {body: {mass: 1 t, initial_velocity: 1}, reduction: {links: 5}}\n  b: {wall: {}}\n",
          {"a", "reduction: none"});
  refused(pair + "  a: {body: {mass: 1 t, initial_velocity: 1}}\n  b: {wall: {}, reduction: {links: 5}}\n",
          {"modes", "wall"});
}

}  // namespace reduction_input_test
}  // namespace pounding
