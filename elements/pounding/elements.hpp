#pragma once
/// All of the modelling layer: structures, frames, links with their laws, ground motions, the model and its reader. The
/// target Pounding::elements; no PETSc.

#include <pounding/core/units.hpp>
#include <pounding/frames/frame_structure.hpp>
#include <pounding/frames/sections.hpp>
#include <pounding/ground/components.hpp>
#include <pounding/ground/record.hpp>
#include <pounding/ground/spectrum.hpp>
#include <pounding/ground/synthetic.hpp>
#include <pounding/hysteresis.hpp>
#include <pounding/input/collision.hpp>
#include <pounding/input/read_model.hpp>
#include <pounding/input/resolved.hpp>
#include <pounding/links.hpp>
#include <pounding/model/contact_law.hpp>
#include <pounding/model/model.hpp>
#include <pounding/model/modes.hpp>
#include <pounding/model/neighbours.hpp>
#include <pounding/pushover/pushover.hpp>
#include <pounding/reports/describe.hpp>
#include <pounding/reports/plausible.hpp>
#include <pounding/structures/oscillators.hpp>
