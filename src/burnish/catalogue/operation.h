#pragma once

#include <functional>
#include <new>
#include <span>
#include <string>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/base/facts.h"
#include "burnish/base/schema.h"
#include "burnish/core/depth_frame.h"
#include "burnish/core/frame_source.h"
#include "burnish/core/point_cloud.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// An operation as texts see it.
struct OperationInfo {
  std::string name;     ///< snake_case, unique in its family
  std::string summary;  ///< one sentence
  std::string paper;    ///< key into docs/bibliography.md, or empty where it is our own
  std::vector<FieldInfo> fields;
};

/// What a creation returns, whatever the operation.
template <class T>
struct Created {
  T value;
  Facts facts;
};

/// An operation behind one signature for its family. `run` reads the settings over the defaults,
/// checks them and calls the typed function; `resolve` gives every parameter as it would be used.
template <class Signature>
struct Operation {
  OperationInfo info;
  std::function<Signature> run;
  std::function<Result<Settings>(const Settings&)> resolve;
};

using AverageOperation = Operation<Result<Created<DepthFrame>>(std::span<const DepthFrame>,
                                                               const Settings&, const Context&)>;
using FilterOperation = Operation<Result<Facts>(DepthFrame&, const Settings&, const Context&)>;
using CleanOperation = Operation<Result<Facts>(PointCloud&, const Settings&, const Context&)>;
using MergeOperation = Operation<Result<Created<PointCloud>>(std::span<const PointCloud>,
                                                             const Settings&, const Context&)>;
using FuseOperation =
    Operation<Result<Created<TriangleMesh>>(const FrameSource&, const Settings&, const Context&)>;
using ThinOperation = Operation<Result<Facts>(PointCloud&, const Settings&, const Context&)>;
using TriangulateOperation =
    Operation<Result<Created<TriangleMesh>>(const PointCloud&, const Settings&, const Context&)>;
using RepairOperation = Operation<Result<Facts>(TriangleMesh&, const Settings&, const Context&)>;
using SimplifyOperation = Operation<Result<Facts>(TriangleMesh&, const Settings&, const Context&)>;
using RefineOperation = Operation<Result<Facts>(TriangleMesh&, const Settings&, const Context&)>;
using SmoothOperation = Operation<Result<Facts>(TriangleMesh&, const Settings&, const Context&)>;

namespace catalogue_detail {

template <class Params, class Call>
auto run_checked(const Settings& settings, Call call) -> decltype(call(Params{})) {
  const Result<Params> params = Params::schema().parse(settings);
  if (!params) return params.error();
  try {
    return call(*params);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::out_of_memory, "not enough memory", {}};
  }
}

template <class Params>
Result<Settings> resolve(const Settings& settings) {
  const Result<Params> params = Params::schema().parse(settings);
  if (!params) return params.error();
  return Params::schema().settings(*params);
}

template <class Params>
OperationInfo describe(std::string name, std::string summary, std::string paper) {
  return {std::move(name), std::move(summary), std::move(paper), Params::schema().fields()};
}

}  // namespace catalogue_detail

/// An edit of a T in place: `Result<Report> function(T&, const Params&, const Context&)`.
template <class T, class Params, class Report>
Operation<Result<Facts>(T&, const Settings&, const Context&)> edit_operation(
    std::string name, Result<Report> (*function)(T&, const Params&, const Context&),
    std::string summary, std::string paper) {
  using namespace catalogue_detail;
  return {describe<Params>(std::move(name), std::move(summary), std::move(paper)),
          [function](T& edited, const Settings& settings, const Context& context) {
            return run_checked<Params>(settings, [&](const Params& params) -> Result<Facts> {
              const Result<Report> report = function(edited, params, context);
              if (!report) return report.error();
              return report->facts();
            });
          },
          resolve<Params>};
}

/// A creation of a T from an Input: `Result<Output> function(Input, const Params&, const
/// Context&)`, where Output holds the T as its member `value` and a report.
template <class Input, class Params, class Output, class T>
Operation<Result<Created<T>>(Input, const Settings&, const Context&)> creation_operation(
    std::string name, Result<Output> (*function)(Input, const Params&, const Context&),
    T Output::*value, std::string summary, std::string paper) {
  using namespace catalogue_detail;
  return {describe<Params>(std::move(name), std::move(summary), std::move(paper)),
          [function, value](Input input, const Settings& settings, const Context& context) {
            return run_checked<Params>(settings, [&](const Params& params) -> Result<Created<T>> {
              Result<Output> output = function(input, params, context);
              if (!output) return std::move(output).error();
              return Created<T>{std::move((*output).*value), output->report.facts()};
            });
          },
          resolve<Params>};
}

}  // namespace burnish
