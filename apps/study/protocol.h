#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/presentation/presentation.h"
#include "apps/study/questionnaire.h"
#include "apps/training/engine.h"
#include "apps/training/trial_words.h"

namespace palpa {
class JsonFile;
}

namespace palpa::study {

/// What is felt, and what of it is shown.
struct Setting {
  bool force_feedback = true;
  std::optional<presentation::Presentation> presentation;  ///< empty: by role and force feedback
  /// Another condition is without force feedback, and none names its presentation: nobody sees the
  /// force, so that conditions differ in what they say and in nothing else
  bool hide_forces = false;
  bool augment = false;          ///< the task's cues are added
  bool skin_deflection = false;  ///< the skin is shown to give way
  bool guide = false;            ///< needle: a line to the vein; such trials are not scored
  bool guidance = false;         ///< palpation: help that fades
  bool navigation = true;        ///< of the view
  std::string mode = "real";     ///< search: real, degraded, augmented
};

struct StudyCondition {
  std::string name, means;
  Setting shows;
};

struct Group {
  std::string name, means;
};

/// Trials that follow each other, of one task.
struct Block {
  std::string name;
  std::filesystem::path task;
  training::Engine engine = training::Engine::needle;  ///< of the task
  training::Role role = training::Role::scored;        ///< of the trials
  int trials = 1;
  std::string condition;    ///< by name; empty: the one that was drawn for the trainee
  int rest_after = 0;       ///< trials; 0: no rest within the block
  double rest_s = 0;        ///< then, and after the block
  std::int64_t step = 0;    ///< 1, 2, ... on the way through the study
  double time_limit_s = 0;  ///< of each trial; 0: the task states none
};

/// How long trials and rests take when each trial lasts as long as its task lets it.
double longestTime_s(const Block& block);

struct Session {
  std::string name;
  int days_after = 0;  ///< at least so many days after the session before
  std::vector<Block> blocks;
  std::optional<Questionnaire> questionnaire;  ///< at its end
};

/// How conditions are drawn: permuted blocks of so many places, in each group by itself.
struct Allocation {
  std::vector<std::string> conditions;  ///< one for each trainee
  int block = 0;
};

/// A study as its file describes it.
struct Protocol {
  std::string id, title, source, sha256;
  std::filesystem::path file;
  std::vector<Group> groups;
  std::vector<StudyCondition> conditions;
  std::optional<Allocation> allocation;  ///< none: all trainees go the same way
  std::vector<Session> sessions;
  std::uint64_t trial_seed = 1;  ///< of the tasks' chances: the same for all trainees
  bool blind_trainee = false,
       blind_educator = false;        ///< must not be told the condition that was drawn
  bool excludes_experts = true;       ///< who made the expert path of a task takes no part
  std::vector<std::string> excluded;  ///< further pseudonyms

  const Group* group(const std::string& name) const;  ///< null: none of that name
  const StudyCondition* condition(const std::string& name) const;
  const Block& block(std::int64_t step) const;  ///< throws Error for a step that there is not
  int sessionOf(std::int64_t step) const;       ///< 1, 2, ...
  bool blind() const { return blind_trainee || blind_educator; }
};

/// Of a trainee's trials and rests in all sessions: "at most 3 h 20 min".
std::string longestTimeInWords(const Protocol& protocol);

/// Throws UsageError naming file and field: version, names, conditions that are unknown, double or
/// not used, counts, rests, task files and their engines.
Protocol readProtocol(const std::filesystem::path& file);

/// A short word that stands in files, tables and folders: as a pseudonym, 1 to 32 letters, digits,
/// - or _. Throws UsageError.
std::string needName(const JsonFile& file, const std::string& field);

/// The condition of a group's place 1, 2, ...: every `block` places hold each condition equally
/// often, in an order drawn anew for each block from (seed, group, block) alone. So the groups are
/// balanced at the end of every block, and who knows all places given so far cannot tell the next
/// one unless a block is nearly full.
std::string conditionOf(const Allocation& allocation, const std::string& group, std::uint64_t seed,
                        std::int64_t place);

}  // namespace palpa::study
