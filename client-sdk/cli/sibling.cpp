#include "client-sdk/cli/sibling.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include <unistd.h>

#include "server/base/program_folder.hpp"

namespace mechane::cli {

int become(const std::string& name, const std::vector<std::string>& arguments) {
  std::string program = (program_folder() / name).string();
  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words)
    argv.push_back(word.data());
  argv.push_back(nullptr);
  execv(program.c_str(), argv.data());
  std::fprintf(stderr, "mechane: cannot run %s: %s; build or install all programs of Mechane into one folder\n",
               program.c_str(), std::strerror(errno));
  return 127;
}

}  // namespace mechane::cli
