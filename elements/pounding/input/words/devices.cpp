#include <pounding/input/words/sections.hpp>

#include <pounding/structures/bar_and_damper.hpp>

namespace pounding::words {
namespace {

constexpr Word device_words[] = {
    {.key = "between", .takes = Takes::text, .form = Form::list, .least = 2, .most = 2, .inside = &link_end, .need = Need::required,
     .since = "0.2.0",
     .meaning = "The two structures, the left one first, with their ends as links name them: A.3 is floor 3 of A. Two nodes of frames "
                "are joined along the line between them; all other ends along the horizontal axis of a link.",
     .example = "[left, right]"},
    {.key = "bar", .inside = &bar, .need = Need::at_least_one, .since = "0.2.0",
     .meaning = "An elastic bar, which pulls and pushes: force = stiffness times elongation. Gravity and preloads leave it undeformed.",
     .example = "{stiffness: 50 MN/m}"},
    {.key = "damper", .inside = &damper, .need = Need::at_least_one, .since = "0.2.0",
     .meaning = "A viscous damper, beside the bar where there is one: force = c |v|^a sign v, with the rate of elongation v.",
     .example = "{coefficient: 200 kN s/m}"}};

constexpr Word bar_words[] = {
    {.key = "stiffness", .takes = Takes::quantity, .dimension = dimension::stiffness, .bounds = bounds::positive,
     .need = Need::exactly_one, .since = "0.2.0", .meaning = "Stiffness of the bar.", .example = "50 MN/m"},
    {.key = "E", .takes = Takes::quantity, .dimension = dimension::stress, .bounds = bounds::positive, .need = Need::exactly_one,
     .since = "0.2.0", .meaning = "Young's modulus: the stiffness is E area/length, with the length that is drawn between two frames.",
     .example = "210 GPa"},
    {.key = "area", .takes = Takes::quantity, .dimension = dimension::area, .bounds = bounds::positive, .since = "0.2.0",
     .meaning = "Area of the section, beside E.", .example = "20 cm^2"}};

constexpr Word damper_words[] = {
    {.key = "coefficient", .takes = Takes::quantity, .dimension = dimension::damping, .unit = "N (s/m)^a", .bounds = bounds::positive,
     .need = Need::required, .since = "0.2.0",
     .meaning = "Coefficient c: the force at 1 m/s. With another exponent than 1 its unit follows: 200 kN (s/m)^0.35.",
     .example = "200 kN s/m"},
    {.key = "exponent", .takes = Takes::quantity, .bounds = {.low = Damper::least_exponent, .high = Damper::largest_exponent},
     .otherwise = "1", .since = "0.2.0", .meaning = "Exponent a of the velocity; 1 is linear.", .example = "1"},
    {.key = "rounding_velocity", .takes = Takes::quantity, .dimension = dimension::velocity, .bounds = bounds::positive,
     .otherwise = "1 mm/s", .since = "0.2.0",
     .meaning = "Velocity v0 that rounds the force near v = 0 where the exponent is not 1: c v (v^2 + v0^2)^((a-1)/2).",
     .example = "1 mm/s"}};

}  // namespace

constinit const Section device{.name = "devices", .place = "devices.NAME",
                               .meaning = "A bar, a damper or both beside each other between two structures.", .words = device_words};
constinit const Section bar{.name = "bar", .place = "devices.NAME.bar", .meaning = "An elastic bar.", .words = bar_words};
constinit const Section damper{.name = "damper", .place = "devices.NAME.damper", .meaning = "A viscous damper.", .words = damper_words};

}  // namespace pounding::words
