// The exhibits that a draft can begin as.
#include <algorithm>
#include <array>

#include "client-sdk/studio/edits/parts.hpp"
#include "server/base/assert.hpp"

namespace mechane::studio {

std::string_view find_template_source(std::string_view name);

namespace {

constexpr std::array<Template, 4> kTemplates{{
    {"empty", "Κενό έκθεμα", "An empty exhibit"},
    {"lever-and-weight", "Μοχλός και βάρος", "A lever and a weight"},
    {"crank-and-rope", "Μανιβέλα και σχοινί", "A crank and a rope"},
    {"gears", "Δύο γρανάζια", "Two gears"},
}};

}  // namespace

std::span<const Template> templates() {
  return kTemplates;
}

const Template* find_template(std::string_view name) {
  const auto found = std::ranges::find(kTemplates, name, &Template::name);
  return found == kTemplates.end() ? nullptr : &*found;
}

std::string text_of(const Template& a_template, std::string_view id) {
  std::string text(find_template_source(a_template.name));
  MECHANE_ASSERT(!text.empty());
  constexpr std::string_view kId = "$ID";
  text.replace(text.find(kId), kId.size(), id);
  return text;
}

}  // namespace mechane::studio
