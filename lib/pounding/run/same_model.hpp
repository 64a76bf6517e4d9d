#pragma once
/// Agreement between processes on what each of them has read.

#include <pounding/model/model.hpp>
#include <pounding/petsc/ranks.hpp>

namespace pounding {

/// Throws InputError on all processes where they have read different models or different records, which processes that
/// work in different folders may under one name. The text names the file and the processes. Collective.
void require_same_model(const petsc::Ranks& ranks, const Model& model);

}  // namespace pounding
