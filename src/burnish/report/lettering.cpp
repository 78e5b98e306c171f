#include "burnish/report/lettering.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "burnish/report/shade.h"

namespace burnish {
namespace {

constexpr int kColumns = 5, kRows = 9, kAdvance = 6;

/// Twelve letters side by side, a line per row of dots; the last two rows are below the base line.
struct Letters {
  std::string_view names;
  std::string_view dots;
};

// clang-format off
constexpr Letters kLetters[] = {
    {"abcdefghijkl",
     "..... #.... ..... ....# ..... ..##. ..... #.... ..#.. ...#. #.... ..#.."
     "..... #.... ..... ....# ..... .#... ..... #.... ..... ..... #.... ..#.."
     ".###. ####. .#### .#### .###. ####. .#### ####. ..#.. ...#. #..#. ..#.."
     "....# #...# #.... #...# #...# .#... #...# #...# ..#.. ...#. #.#.. ..#.."
     ".#### #...# #.... #...# ##### .#... #...# #...# ..#.. ...#. ##... ..#.."
     "#...# #...# #.... #...# #.... .#... #...# #...# ..#.. ...#. #.#.. ..#.."
     ".#### ####. .#### .#### .#### .#... .#### #...# ..#.. ...#. #..#. ..#.."
     "..... ..... ..... ..... ..... ..... ....# ..... ..... ...#. ..... ....."
     "..... ..... ..... ..... ..... ..... .###. ..... ..... .##.. ..... ....."},
    {"mnopqrstuvwx",
     "..... ..... ..... ..... ..... ..... ..... .#... ..... ..... ..... ....."
     "..... ..... ..... ..... ..... ..... ..... .#... ..... ..... ..... ....."
     "##.#. ####. .###. ####. .#### #.##. .#### ####. #...# #...# #.#.# #...#"
     "#.#.# #...# #...# #...# #...# ##... #.... .#... #...# #...# #.#.# .#.#."
     "#.#.# #...# #...# #...# #...# #.... .###. .#... #...# #...# #.#.# ..#.."
     "#.#.# #...# #...# #...# #...# #.... ....# .#... #...# .#.#. #.#.# .#.#."
     "#.#.# #...# .###. ####. .#### #.... ####. ..##. .#### ..#.. .#.#. #...#"
     "..... ..... ..... #.... ....# ..... ..... ..... ..... ..... ..... ....."
     "..... ..... ..... #.... ....# ..... ..... ..... ..... ..... ..... ....."},
    {"yz0123456789",
     "..... ..... .###. ..#.. .###. .###. ...#. ##### .###. ##### .###. .###."
     "..... ..... #...# .##.. #...# #...# ..##. #.... #.... ....# #...# #...#"
     "#...# ##### #...# ..#.. ....# ....# .#.#. ####. #.... ...#. #...# #...#"
     "#...# ...#. #...# ..#.. ...#. ..##. #..#. ....# ####. ...#. .###. .####"
     "#...# ..#.. #...# ..#.. ..#.. ....# ##### ....# #...# ..#.. #...# ....#"
     "#...# .#... #...# ..#.. .#... #...# ...#. #...# #...# ..#.. #...# ....#"
     ".#### ##### .###. .###. ##### .###. ...#. .###. .###. ..#.. .###. .###."
     "....# ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ....."
     ".###. ..... ..... ..... ..... ..... ..... ..... ..... ..... ..... ....."},
    {"-.,:/()%+=_?",
     "..... ..... ..... ..... ....# ...#. .#... ##..# ..... ..... ..... .###."
     "..... ..... ..... ..... ....# ..#.. ..#.. ##.#. ..#.. ..... ..... #...#"
     "..... ..... ..... ..... ...#. .#... ...#. ...#. ..#.. ..... ..... ....#"
     "..... ..... ..... ..#.. ..#.. .#... ...#. ..#.. ##### ####. ..... ..##."
     ".###. ..... ..... ..... .#... .#... ...#. .#... ..#.. ..... ..... ..#.."
     "..... ..... ..... ..... #.... ..#.. ..#.. .#.## ..#.. ####. ..... ....."
     "..... ..#.. ..#.. ..#.. #.... ...#. .#... #..## ..... ..... ..... ..#.."
     "..... ..... ..#.. ..... ..... ..... ..... ..... ..... ..... ##### ....."
     "..... ..... .#... ..... ..... ..... ..... ..... ..... ..... ..... ....."},
};
// clang-format on

/// The dots of one letter.
class Glyph {
 public:
  explicit Glyph(char letter) {
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
    for (const Letters& letters : kLetters) {
      const std::size_t at = letters.names.find(letter);
      if (at == std::string_view::npos) continue;
      dots_ = letters.dots;
      first_ = at * kAdvance;
      line_ = letters.names.size() * kAdvance - 1;
    }
  }

  bool known() const { return !dots_.empty(); }

  bool dot(int column, int row) const {
    if (column < 0 || column >= kColumns || row < 0 || row >= kRows) return false;
    return dots_[static_cast<std::size_t>(row) * line_ + first_ +
                 static_cast<std::size_t>(column)] == '#';
  }

 private:
  std::string_view dots_;
  std::size_t first_ = 0, line_ = 0;
};

struct Stroke {
  double x1, y1, x2, y2;
};

/// Lines between neighbouring dots; a diagonal one only where no corner joins the two.
std::vector<Stroke> strokes(const Glyph& glyph) {
  std::vector<Stroke> result;
  for (int y = 0; y < kRows; ++y) {
    for (int x = 0; x < kColumns; ++x) {
      if (!glyph.dot(x, y)) continue;
      result.push_back({x + 0.0, y + 0.0, x + 0.0, y + 0.0});
      for (const auto& [dx, dy] : {std::array{1, 0}, {0, 1}, {1, 1}, {-1, 1}}) {
        const bool corner = dx != 0 && dy != 0 && (glyph.dot(x + dx, y) || glyph.dot(x, y + dy));
        if (glyph.dot(x + dx, y + dy) && !corner) {
          result.push_back({x + 0.0, y + 0.0, x + dx + 0.0, y + dy + 0.0});
        }
      }
    }
  }
  return result;
}

double distance(const Stroke& s, double x, double y) {
  const double dx = s.x2 - s.x1, dy = s.y2 - s.y1, length = dx * dx + dy * dy;
  const double along = length > 0 ? ((x - s.x1) * dx + (y - s.y1) * dy) / length : 0;
  const double t = std::clamp(along, 0.0, 1.0);
  return std::hypot(x - s.x1 - t * dx, y - s.y1 - t * dy);
}

void draw(Image& image, double column, double row, const Glyph& glyph, const Light& ink,
          double size) {
  const std::vector<Stroke> lines = strokes(glyph);
  const double pen = 0.42 * size;
  const auto last = [](double end, std::uint32_t limit) {
    return static_cast<std::int64_t>(std::min(std::ceil(end), limit - 1.0));
  };
  const std::int64_t bottom = last(row + kRows * size, image.height);
  const std::int64_t right = last(column + kAdvance * size, image.width);
  for (auto y = static_cast<std::int64_t>(std::max(0.0, row - size)); y <= bottom; ++y) {
    for (auto x = static_cast<std::int64_t>(std::max(0.0, column - size)); x <= right; ++x) {
      double nearest = kRows;
      for (const Stroke& line : lines) {
        nearest = std::min(nearest, distance(line, (static_cast<double>(x) - column) / size,
                                             (static_cast<double>(y) - row) / size));
      }
      const double cover = std::clamp(pen + 0.5 - nearest * size, 0.0, 1.0);
      if (cover <= 0) continue;
      Color& pixel = image.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
      pixel = srgb(mix(linear(pixel), ink, cover));
    }
  }
}

/// Calls `write(place, letter)` for every UTF-8 character of `text`.
template <class Write>
void for_each_letter(std::string_view text, Write write) {
  static constexpr std::pair<std::string_view, char> kAlike[] = {{"\u202f", ' '}, {"µ", 'u'}};
  for (int place = 0; !text.empty(); ++place) {
    std::size_t length = 1;
    while (length < text.size() && (static_cast<unsigned char>(text[length]) & 0xC0u) == 0x80u) {
      ++length;
    }
    char letter = length == 1 ? text.front() : '?';
    for (const auto& [character, alike] : kAlike) {
      if (text.substr(0, length) == character) letter = alike;
    }
    write(place, letter);
    text.remove_prefix(length);
  }
}

}  // namespace

double text_width(std::string_view text, double size) {
  int letters = 0;
  for_each_letter(text, [&](int, char) { ++letters; });
  return letters * kAdvance * size;
}

void write_text(Image& image, double column, double row, std::string_view text, const Color& color,
                double size) {
  if (image.pixels.empty()) return;
  const Light ink = linear(color);
  for_each_letter(text, [&](int place, char letter) {
    if (letter == ' ') return;
    const Glyph glyph(letter);
    draw(image, column + place * kAdvance * size, row, glyph.known() ? glyph : Glyph('?'), ink,
         size);
  });
}

}  // namespace burnish
