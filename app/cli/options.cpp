#include "app/cli/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <string_view>
#include <system_error>
#include <utility>

#include "app/base/error.h"

namespace trisect {
namespace {

// Reads the number that `text` begins with and removes it; false if there is none.
template <typename Number>
bool take_number(std::string_view& text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

bool take_character(std::string_view& text, char c) {
  if (!text.starts_with(c)) return false;
  text.remove_prefix(1);
  return true;
}

struct NamedAov {
  const char* name;
  Aov aov;
};

constexpr NamedAov kAovs[] = {{"color", Aov::color}, {"Z", Aov::depth},     {"N", Aov::normal},
                              {"G", Aov::geometric}, {"patch", Aov::patch}, {"uv", Aov::uv},
                              {"P", Aov::position},  {"evals", Aov::evals}};

// Calls take(word) for each of the words that commas separate; empty ones too.
template <typename Take>
void for_each_word(std::string_view text, Take&& take) {
  while (true) {
    const std::string_view word = text.substr(0, text.find(','));
    take(word);
    if (word.size() == text.size()) return;
    text.remove_prefix(word.size() + 1);
  }
}

// Adds an item to a list, in which it must not be yet.
template <typename Item>
void add_new(const std::string& option, std::string_view name, Item item, std::vector<Item>& list) {
  if (std::find(list.begin(), list.end(), item) != list.end()) {
    throw UsageError(fmt::format("{}: '{}' is there twice.", option, name));
  }
  list.push_back(item);
}

constexpr Backend kBackends[] = {Backend::vulkan, Backend::opengl, Backend::cpu, Backend::oracle};

// "1,-2.5,3e2"; nothing for any other text.
std::optional<glm::dvec3> three_numbers(std::string_view text) {
  glm::dvec3 value(0.0);
  const bool parsed = take_number(text, value.x) && take_character(text, ',') &&
                      take_number(text, value.y) && take_character(text, ',') &&
                      take_number(text, value.z) && text.empty();
  return parsed ? std::optional(value) : std::nullopt;
}

}  // namespace

void parse_size(const std::string& option, const std::string& text, uint32_t& width,
                uint32_t& height) {
  constexpr uint32_t largest = kLargestSide;
  std::string_view rest = text;
  const bool parsed = take_number(rest, width) && take_character(rest, 'x') &&
                      take_number(rest, height) && rest.empty();
  if (!parsed || width < 1 || height < 1 || width > largest || height > largest) {
    throw UsageError(fmt::format("{}: '{}' is not a size such as 800x600 (1 to {} pixels a side).",
                                 option, text, largest));
  }
}

glm::dvec3 parse_triple(const std::string& option, const std::string& text) {
  const std::optional<glm::dvec3> value = three_numbers(text);
  // Well beyond the coordinates that the bake allows a model. NaN fails the comparisons below.
  constexpr double largest = 1e12;
  const auto fits = [](double x) { return std::abs(x) <= largest; };
  if (!value || !fits(value->x) || !fits(value->y) || !fits(value->z)) {
    throw UsageError(fmt::format("{}: '{}' is not three numbers such as 1,2.5,-3 of at most {:g}.",
                                 option, text, largest));
  }
  return *value;
}

glm::dvec3 parse_direction(const std::string& option, const std::string& text) {
  const glm::dvec3 direction = parse_triple(option, text);
  if (direction == glm::dvec3(0.0)) throw UsageError(option + ": 0,0,0 is no direction.");
  return direction;
}

glm::dvec3 parse_color(const std::string& option, const std::string& text,
                       const std::string& or_else) {
  const std::optional<glm::dvec3> value = three_numbers(text);
  const auto is_share = [](double x) { return x >= 0.0 && x <= 1.0; };
  if (!value || !is_share(value->x) || !is_share(value->y) || !is_share(value->z)) {
    throw UsageError(
        fmt::format("{}: '{}' is not {}a colour, three numbers from 0 to 1 such as 0.5,0.7,1.",
                    option, text, or_else));
  }
  return *value;
}

std::string background_text(Background background, const glm::dvec3& color) {
  return background == Background::color ? fmt::format("{},{},{}", color.x, color.y, color.z)
                                         : background_name(background);
}

std::vector<Aov> parse_aovs(const std::string& option, const std::string& text) {
  std::vector<Aov> aovs;
  for_each_word(text, [&](std::string_view word) {
    const auto* named = std::find_if(std::begin(kAovs), std::end(kAovs),
                                     [&](const NamedAov& known) { return word == known.name; });
    if (named == std::end(kAovs)) {
      throw UsageError(fmt::format("{}: '{}' is not one of: color, Z, N, G, patch, uv, P, evals.",
                                   option, word));
    }
    add_new(option, word, named->aov, aovs);
  });
  return aovs;
}

std::string aovs_text(const std::vector<Aov>& aovs) {
  std::string text;
  for (const NamedAov& known : kAovs) {
    if (std::find(aovs.begin(), aovs.end(), known.aov) == aovs.end()) continue;
    if (!text.empty()) text += ",";
    text += known.name;
  }
  return text;
}

FrameRange parse_frames(const std::string& option, const std::string& text) {
  FrameRange range;
  std::string_view rest = text;
  bool parsed = take_number(rest, range.first);
  range.last = range.first;
  if (parsed && take_character(rest, ':')) parsed = take_number(rest, range.last);
  if (!parsed || !rest.empty() || range.last < range.first) {
    throw UsageError(
        fmt::format("{}: '{}' is not a frame, such as 7, or a first and a last one, such as 0:59.",
                    option, text));
  }
  return range;
}

ImagePart parse_part(const std::string& option, const std::string& text, uint32_t image_width,
                     uint32_t image_height) {
  ImagePart part;
  std::string_view rest = text;
  const bool parsed = take_number(rest, part.x) && take_character(rest, ',') &&
                      take_number(rest, part.y) && take_character(rest, ',') &&
                      take_number(rest, part.width) && take_character(rest, ',') &&
                      take_number(rest, part.height) && rest.empty();
  if (!parsed) {
    throw UsageError(
        fmt::format("{}: '{}' is not X,Y,WIDTH,HEIGHT such as 0,0,100,50.", option, text));
  }
  if (!part.is_in(image_width, image_height)) {
    throw UsageError(fmt::format("{}: {} is not in an image of {}x{}.", option, text, image_width,
                                 image_height));
  }
  return part;
}

std::string part_text(const ImagePart& part) {
  return fmt::format("{},{},{},{}", part.x, part.y, part.width, part.height);
}

Backend backend_named(const std::string& option, std::string_view name) {
  for (const Backend backend : kBackends) {
    if (name == backend_name(backend)) return backend;
  }
  throw UsageError(
      fmt::format("{}: '{}' is not one of: vulkan, opengl, cpu, oracle.", option, name));
}

std::vector<Backend> parse_backends(const std::string& option, const std::string& text) {
  std::vector<Backend> backends;
  for_each_word(text, [&](std::string_view name) {
    add_new(option, name, backend_named(option, name), backends);
  });
  if (backends.size() < 2) throw UsageError(option + ": two or more are needed.");
  return backends;
}

void parse_threshold(const std::string& option, const std::string& text, Tolerance& tolerance) {
  const std::pair<const char*, double*> members[] = {
      {"hit_mismatches", &tolerance.hit_mismatches},
      {"patch_mismatches", &tolerance.patch_mismatches},
      {"z_differs", &tolerance.z_differs},
      {"color_rmse", &tolerance.color_rmse},
      {"color_max", &tolerance.color_max},
      {"alpha_max", &tolerance.alpha_max},
      {"nan_pixels", &tolerance.nan_pixels}};
  const std::size_t equals = text.find('=');
  for (const auto& [name, member] : members) {
    if (equals == std::string::npos || text.substr(0, equals) != name) continue;
    std::string_view rest = std::string_view(text).substr(equals + 1);
    double value = 0.0;
    if (take_number(rest, value) && rest.empty() && value >= 0.0) {
      *member = value;
      return;
    }
  }
  throw UsageError(
      fmt::format("{}: '{}' is not NAME=NUMBER with a name of: hit_mismatches, patch_mismatches, "
                  "z_differs, color_rmse, color_max, alpha_max, nan_pixels.",
                  option, text));
}

}  // namespace trisect
