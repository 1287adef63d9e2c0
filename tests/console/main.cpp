#include <gtest/gtest.h>

#include <cstring>

#include "played_command.h"

/// A console starts its own program anew, under the name "palpa": here that is this one, and it
/// plays what was asked for.
int main(int count, char** arguments) {
  if (count > 1 && std::strcmp(arguments[0], "palpa") == 0)
    return palpa::console::playCommand({arguments + 1, arguments + count});
  ::testing::InitGoogleTest(&count, arguments);
  return RUN_ALL_TESTS();
}
