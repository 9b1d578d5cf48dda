#include <fmt/format.h>

#include "cli/command.h"
#include "cli/command_tree.h"

namespace touchstone::cli {

Run declare_completion(CLI::App& app) {
  auto shell = std::make_shared<std::string>();
  app.add_option("shell", *shell, "bash, zsh or fish")->required();
  app.footer("In bash: eval \"$(touchstone completion bash)\"");
  return [shell, &app] {
    fmt::print("{}", completion(command_tree(*app.get_parent()), *shell));
    return exit_clean;
  };
}

Run declare_man(CLI::App& app) {
  auto markdown = std::make_shared<bool>(false);
  app.add_flag("--markdown", *markdown, "write docs/commands.md instead");
  app.footer("To read it: touchstone man | man -l -");
  return [markdown, &app] {
    const CommandNode root = command_tree(*app.get_parent());
    fmt::print("{}", *markdown ? command_reference(root) : manual_page(root, TOUCHSTONE_VERSION));
    return exit_clean;
  };
}

}  // namespace touchstone::cli
