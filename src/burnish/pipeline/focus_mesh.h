#pragma once

#include <span>
#include <string>

#include "burnish/adaptation/adaptive_mesh.h"
#include "burnish/pipeline/record.h"

namespace burnish {

/// Makes `mesh` as fine as `focus` says in `region` (as read_selection has it) and as coarse
/// outside, by removing vertices in the order of removal_log; none is moved. Between the two
/// triangles grow step by step: a region needs some around it. Vertices without a triangle go too.
/// The record gets what was done. O(#T log #T). Errors: those of read_selection and removal_log;
/// invalid_argument where no vertex lies in the region; cancelled; `mesh` is then unchanged.
Result<void> focus_mesh(TriangleMesh& mesh, const std::string& region, const Focus& focus,
                        Record& record, const Context& context = {});

/// The same along a log of removals that `mesh` came with; vertices without a triangle stay.
Result<void> focus_mesh(TriangleMesh& mesh, std::span<const Removal> log, const std::string& region,
                        const Focus& focus, Record& record, const Context& context = {});

}  // namespace burnish
