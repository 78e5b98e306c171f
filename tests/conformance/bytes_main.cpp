#include <cstdio>

#include "conformance/subject.h"

// Prints a digest of what every operation makes of its sample, with its defaults and with each
// field set to other values. Two builds agree where their outputs are equal.
int main() {
  using namespace burnish::test;
  for (const Subject& subject : subjects()) {
    const auto print = [&](const burnish::Settings& settings) {
      const auto outcome = subject.outcome(settings);
      const std::string method = to_string(burnish::Method{subject.name(), settings});
      const std::string result = outcome ? digest(bytes(*outcome)) : outcome.error().text();
      std::printf("%s %s\n", method.c_str(), result.c_str());
    };
    print({});
    for (const burnish::FieldInfo& field : subject.info.fields) {
      for (const burnish::Settings& settings : variations(subject, field)) print(settings);
    }
  }
}
