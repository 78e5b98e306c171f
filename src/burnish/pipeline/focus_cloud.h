#pragma once

#include <string>

#include "burnish/base/context.h"
#include "burnish/base/result.h"
#include "burnish/core/point_cloud.h"
#include "burnish/pipeline/record.h"

namespace burnish {

/// Thins `cloud` outside of `region` (as read_selection has it) to at most `outside_points` points,
/// half of them where that is 0, in the order of the information they carry (thin_by_fans); inside
/// all stay. The record gets what was done. Errors: those of read_selection and thin_by_fans;
/// invalid_argument where no point lies in the region; cancelled; `cloud` is then unchanged.
Result<void> focus_cloud(PointCloud& cloud, const std::string& region, std::size_t outside_points,
                         Record& record, const Context& context = {});

}  // namespace burnish
