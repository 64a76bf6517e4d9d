#pragma once
/// Structures, ground motions, models and their reader: the target Pounding::elements. No PETSc.

#include <pounding/core/units.hpp>
#include <pounding/frames/frame_structure.hpp>
#include <pounding/ground/record.hpp>
#include <pounding/ground/spectrum.hpp>
#include <pounding/ground/synthetic.hpp>
#include <pounding/input/collision.hpp>
#include <pounding/input/input.hpp>
#include <pounding/links.hpp>
#include <pounding/model/ground_plan.hpp>
#include <pounding/model/model.hpp>
#include <pounding/model/modes.hpp>
#include <pounding/structures/bilinear_spring.hpp>
#include <pounding/structures/oscillators.hpp>
