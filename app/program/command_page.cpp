#include "app/program/command_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "app/cli/option_groups.h"

namespace trisect {
namespace {

std::string path_of(const CLI::App& app) {
  const CLI::App* parent = app.get_parent();
  return parent == nullptr ? app.get_name() : path_of(*parent) + ' ' + app.get_name();
}

OptionPage option_page(const CLI::Option& option) {
  OptionPage page;
  page.is_argument = !option.nonpositional();
  if (page.is_argument) page.names = {option.get_name(true)};
  for (const std::string& name : option.get_snames()) page.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) page.names.push_back("--" + name);
  const bool is_flag = option.get_items_expected_max() == 0;
  if (!is_flag && !page.is_argument) page.value = option.get_type_name();
  page.group = option.get_group();
  page.text = option.get_description();
  page.is_required = option.get_required();
  page.may_repeat = option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
  page.suggestions = suggestions_of(option);
  return page;
}

// "-o FILE", "MODEL..."
std::string short_form(const OptionPage& option) {
  std::string text = option.names.front();
  if (!option.value.empty()) text += ' ' + option.value;
  return text + (option.is_argument && option.may_repeat ? "..." : "");
}

std::string usage_of(const CommandPage& page, const std::vector<std::string>& choices) {
  std::string usage = page.path;
  if (!page.commands.empty()) return usage + " COMMAND [OPTION]...";
  for (const bool arguments : {true, false}) {
    for (const OptionPage& option : page.options) {
      if (option.is_argument != arguments) continue;
      if (option.is_required) usage += ' ' + short_form(option);
      if (option.is_argument && !option.is_required) usage += " [" + short_form(option) + ']';
    }
  }
  for (const std::string& choice : choices) usage += " (" + choice + ')';
  return usage + " [OPTION]...";
}

}  // namespace

std::string OptionPage::heading() const {
  std::string words = fmt::format("{}", fmt::join(names, ", "));
  if (is_argument && may_repeat) words += "...";
  return value.empty() ? words : words + ' ' + value;
}

std::string CommandPage::name() const {
  return path.substr(path.rfind(' ') + 1);
}

CommandPage command_page(const CLI::App& app) {
  CommandPage page;
  page.path = path_of(app);
  page.summary = app.get_description();
  for (const CLI::Option* option : app.get_options()) page.options.push_back(option_page(*option));
  for (const CLI::App* sub : app.get_subcommands({})) page.commands.push_back(command_page(*sub));
  // Of two options that exclude each other one is required. Each names the other.
  std::vector<std::string> choices;
  std::set<const CLI::Option*> named;
  for (const CLI::Option* option : app.get_options()) {
    for (const CLI::Option* other : option->get_excludes()) {
      named.insert(other);
      if (named.count(option) > 0) continue;
      choices.push_back(fmt::format("{} | {}", short_form(option_page(*option)),
                                    short_form(option_page(*other))));
    }
  }
  page.usage = usage_of(page, choices);
  return page;
}

std::vector<OptionGroup> option_groups(const CommandPage& page) {
  std::vector<OptionGroup> groups;
  groups.reserve(option_group::kAll.size());
  for (const char* name : option_group::kAll) groups.push_back({name, {}});
  for (const OptionPage& option : page.options) {
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&](const OptionGroup& g) { return g.name == option.group; });
    if (group == groups.end()) group = groups.insert(groups.end(), {option.group, {}});
    group->options.push_back(&option);
  }
  for (OptionGroup& group : groups) {
    std::stable_partition(group.options.begin(), group.options.end(),
                          [](const OptionPage* option) { return option->is_argument; });
  }
  std::erase_if(groups, [](const OptionGroup& group) { return group.options.empty(); });
  return groups;
}

std::vector<const CommandPage*> all_pages(const CommandPage& page) {
  std::vector<const CommandPage*> pages{&page};
  for (const CommandPage& command : page.commands) {
    const std::vector<const CommandPage*> below = all_pages(command);
    pages.insert(pages.end(), below.begin(), below.end());
  }
  return pages;
}

}  // namespace trisect
