#pragma once

#include <ostream>

#include "burnish/catalogue/operations.h"
#include "conformance/workpiece.h"

namespace burnish::test {

/// An operation of the catalogue, whatever its family, and an input that makes it work.
struct Subject {
  std::string family;
  OperationInfo info;
  Workpiece sample;
  /// Edits change `input` and give a copy of it as output; creations leave it.
  std::function<Result<Outcome>(Workpiece& input, const Settings&, const Context&)> run;
  std::function<Result<Settings>(const Settings&)> resolve;

  std::string name() const { return family + "/" + info.name; }
  bool takes_frames() const {
    return family == "average" || family == "filter" || family == "fuse";
  }
  bool takes_mesh() const {
    return family == "repair" || family == "smooth" || family == "simplify" || family == "refine";
  }

  /// What comes of a copy of the sample.
  Result<Outcome> outcome(const Settings& settings = {}, const Context& context = {}) const {
    return outcome_of(sample, settings, context);
  }
  Result<Outcome> outcome_of(Workpiece input, const Settings& settings = {},
                             const Context& context = {}) const {
    return run(input, settings, context);
  }
};

/// Every operation of the catalogue.
const std::vector<Subject>& subjects();

/// The settings of one field that differ from its default and are allowed, the nearer ones first.
std::vector<Settings> variations(const Subject& subject, const FieldInfo& field);

/// As the parameter of a test, of which there are many: a subject holds whole meshes.
struct SubjectRef {
  const Subject* subject;
};
std::vector<SubjectRef> subject_refs();

inline std::ostream& operator<<(std::ostream& out, const SubjectRef& ref) {
  return out << ref.subject->name();
}

}  // namespace burnish::test
