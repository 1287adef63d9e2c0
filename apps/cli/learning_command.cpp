#include <algorithm>
#include <cstdio>
#include <memory>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"
#include "apps/cli/arguments.h"
#include "apps/cli/commands.h"
#include "apps/cli/values.h"
#include "apps/console/task_choices.h"
#include "apps/learning/cmi5_package.h"
#include "apps/learning/lti_launch.h"
#include "apps/learning/settings.h"

namespace palpa::cli {
namespace {

namespace fs = std::filesystem;
using learning::Platform;
using learning::PlatformKind;
using learning::Settings;

/// Of the console, for all commands.
struct LearningOptions {
  std::string home, address, performer;
  int trials = 0;
  learning::Folder folder() const {
    return learning::Folder(fs::absolute(home.empty() ? usualConsoleHome() : fs::path(home)));
  }
  /// As they are, with what was given.
  Settings settings() const {
    Settings s = readSettings(folder());
    if (!address.empty()) s.address = address.ends_with('/') ? address : address + '/';
    if (!performer.empty()) s.performer = performer;
    if (trials > 0) s.trials = trials;
    return s;
  }
};

void keepPlatform(const LearningOptions& o, const Platform& platform) {
  Settings s = o.settings();
  if (s.address.empty())
    throw UsageError("is not known yet", "the address by which browsers reach this console",
                     "Give it, as the console prints it: --address https://bench1.local:8443/");
  std::erase_if(s.platforms, [&](const Platform& one) { return one.name == platform.name; });
  s.platforms.push_back(platform);
  writeSettings(o.folder(), s);
  std::printf("%s may launch tasks here. What it is to be told: palpa console learning\n",
              platform.name.c_str());
}

void removePlatform(const LearningOptions& o, const std::string& name) {
  Settings s = o.settings();
  if (std::erase_if(s.platforms, [&](const Platform& one) { return one.name == name; }) == 0)
    throw UsageError("is not configured", name, "Look at: palpa console learning");
  writeSettings(o.folder(), s);
  std::printf("%s may launch nothing here any more\n", name.c_str());
}

void tellLti(const Settings& s) {
  std::printf("  Register this console there as a tool of LTI 1.3:\n");
  std::printf("    login address      %s\n", loginAddress(s).c_str());
  std::printf("    redirection        %s\n", launchAddress(s).c_str());
  std::printf("    keys               %s\n", keysAddress(s).c_str());
  std::printf("    link of a task     %slearning/lti/paracentesis (opened in a new window)\n",
              s.address.c_str());
}

void tell(const LearningOptions& o) {
  const Settings s = o.settings();
  if (s.isOff()) {
    std::printf(
        "No learning management system may launch tasks here. To let one: palpa console "
        "learning cmi5 --help, or lti --help\n");
    return;
  }
  std::printf("Browsers reach this console at %s\n", s.address.c_str());
  std::printf("A launched session has %s, held by: %s\n",
              s.trials == 1 ? "1 trial" : (std::to_string(s.trials) + " trials").c_str(),
              s.performer.c_str());
  for (const Platform& platform : s.platforms) {
    const bool lti = platform.kind == PlatformKind::lti;
    std::printf("%s (%s): %s\n", platform.name.c_str(), lti ? "LTI 1.3" : "cmi5",
                (lti ? platform.issuer : platform.origin).c_str());
    if (lti)
      tellLti(s);
    else
      std::printf("  Import there the course that this makes: palpa console learning package\n");
  }
}

void makePackage(const LearningOptions& o, const std::string& out) {
  const Settings s = o.settings();
  if (s.address.empty())
    throw UsageError("is not known yet", "the address by which browsers reach this console",
                     "Give it: --address https://bench1.local:8443/");
  std::vector<learning::CourseTask> tasks;
  for (const console::TaskChoice& task : console::taskChoices())
    tasks.push_back({task.id, task.title, task.brief});
  writeWhole(out, learning::coursePackage(learning::courseStructure(tasks, s.address)));
  std::printf("Written: %s, a course of %zu tasks\n", out.c_str(), tasks.size());
}

void addOptions(CLI::App& command, const std::shared_ptr<LearningOptions>& o) {
  command
      .add_option("--home", o->home, "The console's folder (default ~/.local/share/palpa/console)")
      ->type_name("DIR");
  command
      .add_option("--address", o->address,
                  "How browsers of trainees reach this console, as it prints it")
      ->type_name("URL");
}

void addSessionOptions(CLI::App& command, const std::shared_ptr<LearningOptions>& o) {
  command.add_option("--operator", o->performer, "Who performs launched sessions (default person)")
      ->check(oneOf({"person", "expert", "novice"}));
  command.add_option("--trials", o->trials, "Trials of a launched session (default 1)")
      ->check(inRange(1, 50));
}

void addCmi5(CLI::App& parent) {
  const auto o = std::make_shared<LearningOptions>();
  const auto p = std::make_shared<Platform>();
  CLI::App* command =
      parent.add_subcommand("cmi5", "Let a learning management system launch tasks by cmi5");
  command->add_option("name", p->name, "What it is called here: letters, digits, - and _")
      ->required();
  command
      ->add_option("--from", p->origin,
                   "Its address: launches come from there, statements go there")
      ->required()
      ->type_name("URL");
  addOptions(*command, o);
  addSessionOptions(*command, o);
  command->footer(
      "Examples:\n  palpa console learning cmi5 campus --from https://lms.example \\\n"
      "    --address https://bench1.local:8443/\n"
      "  palpa console learning package --out palpa-course.zip\n"
      "      the course to import there");
  command->callback([o, p] { keepPlatform(*o, *p); });
}

void addLti(CLI::App& parent) {
  const auto o = std::make_shared<LearningOptions>();
  const auto p = std::make_shared<Platform>();
  p->kind = PlatformKind::lti;
  CLI::App* command =
      parent.add_subcommand("lti", "Let a learning management system launch tasks by LTI 1.3");
  command->add_option("name", p->name, "What it is called here: letters, digits, - and _")
      ->required();
  struct Asked {
    const char *option, *help, *type;
    std::string Platform::*field;
  };
  for (const Asked& one :
       {Asked{"--issuer", "Who it says it is", "URL", &Platform::issuer},
        Asked{"--client", "What it calls this tool", "ID", &Platform::client_id},
        Asked{"--login", "Where it logs people in", "URL", &Platform::login},
        Asked{"--token", "Where it gives access to scores", "URL", &Platform::token},
        Asked{"--keys", "Where it publishes its keys", "URL", &Platform::keys}})
    command->add_option(one.option, (*p).*one.field, one.help)->required()->type_name(one.type);
  command
      ->add_option("--deployment", p->deployments, "Its deployments from which tasks are launched")
      ->required()
      ->type_name("ID...");
  addOptions(*command, o);
  addSessionOptions(*command, o);
  command->footer(
      "Examples:\n  palpa console learning lti campus --issuer https://lms.example --client 10001 "
      "\\\n"
      "    --deployment 1 --login https://lms.example/auth --token https://lms.example/token \\\n"
      "    --keys https://lms.example/keys --address https://bench1.local:8443/\n"
      "      as the system's page of the registered tool tells them");
  command->callback([o, p] { keepPlatform(*o, *p); });
}

void addPackage(CLI::App& parent) {
  const auto o = std::make_shared<LearningOptions>();
  const auto out = std::make_shared<std::string>("palpa-course.zip");
  CLI::App* command = parent.add_subcommand(
      "package", "The tasks of this station as a course of cmi5, to import there");
  command->add_option("--out", *out, "File to write (default palpa-course.zip)")->type_name("FILE");
  addOptions(*command, o);
  command->footer("Examples:\n  palpa console learning package --out palpa-course.zip");
  command->callback([o, out] { makePackage(*o, *out); });
}

void addRemove(CLI::App& parent) {
  const auto o = std::make_shared<LearningOptions>();
  const auto name = std::make_shared<std::string>();
  CLI::App* command =
      parent.add_subcommand("remove", "Let a learning management system launch nothing any more");
  command->add_option("name", *name, "What it is called here")->required();
  addOptions(*command, o);
  command->footer("Examples:\n  palpa console learning remove campus");
  command->callback([o, name] { removePlatform(*o, *name); });
}

}  // namespace

void addLearning(CLI::App& console) {
  const auto o = std::make_shared<LearningOptions>();
  CLI::App* command = console.add_subcommand(
      "learning", "Which learning management systems may launch tasks here (cmi5, LTI 1.3)");
  addOptions(*command, o);
  command->require_subcommand(0, 1);
  command->footer(
      "Examples:\n  palpa console learning\n      which there are, and what each is to be told\n"
      "  palpa console learning cmi5 campus --from https://lms.example\n"
      "  palpa console learning remove campus");
  addCmi5(*command);
  addLti(*command);
  addPackage(*command);
  addRemove(*command);
  command->callback([o, command] {
    if (command->get_subcommands().empty()) tell(*o);
  });
}

}  // namespace palpa::cli
