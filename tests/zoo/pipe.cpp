// A command behind a pipe that misbehaves in the way that its argument names: when queried about the pair (0,
// 2) of a scene whose body 0 lies at x = 666, or at its start.
#include <signal.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iostream>
#include <map>
#include <string>

namespace {

void say(const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t n = write(1, text.data() + done, text.size() - done);
    if (n <= 0) _exit(0);
    done += static_cast<std::size_t>(n);
  }
}

void for_ever() {
  for (;;) pause();
}

std::string card(const std::string& name) {
  return "{\"touchstone_pipe\":1,\"name\":\"" + name +
         "\",\"library\":\"zoo\",\"version\":\"1\",\"settings\":\"\",\"unit_roundoff\":1e-16,\"tau_factor\":"
         "64,"
         "\"source\":\"\"}\n";
}

const std::map<std::string, std::function<void()>> starts{
    {"no_card", [] { for_ever(); }},
    {"garbage_card", [] { say("\x01\x02\xff\xfe garbage\n"); }},
    {"empty_card", [] { say("{}\n"); }},
    {"list_card", [] { say("[1, 2]\n"); }},
    {"card_of_version_7", [] { say("{\"touchstone_pipe\": 7}\n"); }},
    {"card_without_end",
     [] {
       say("{\"touchstone_pipe\": 1, ");
       for_ever();
     }},
    {"card_in_latin1", [] { say("{\"touchstone_pipe\":1,\"name\":\"Gr\xf6\xdf\"}\n"); }},
    {"deep_card", [] { say(std::string(200000, '[') + "\n"); }},
    {"exits_at_once", [] { _exit(3); }},
    {"spams_before_its_card",
     [] {
       for (int i = 0; i < 100000; ++i) say("hello\n");
     }},
};

const std::map<std::string, std::function<void()>> answers{
    {"good", [] {}},
    {"garbage", [] { say("\x01\x02 garbage\n"); }},
    {"bad_utf8", [] { say("{\"overlap\": \"\xff\xfe\"}\n"); }},
    {"cut_utf8", [] { say("{\"outcome\":\"threw\",\"detail\":\"caf\xc3\"}\n"); }},
    {"line_without_end",
     [] {
       const std::string block(1 << 16, 'x');
       for (int i = 0; i < 6000; ++i) say(block);
       for_ever();
     }},
    {"no_newline",
     [] {
       say("{\"overlap\": true}");
       for_ever();
     }},
    {"slow_bytes",
     [] {
       for (const char c : std::string("{\"overlap\":false,\"distance\":20}\n")) {
         say(std::string(1, c));
         usleep(1000);
       }
     }},
    {"closes_its_output",
     [] {
       close(1);
       for_ever();
     }},
    {"wrong_types", [] { say("{\"overlap\": 3.5, \"normal\": \"up\"}\n"); }},
    {"short_vector", [] { say("{\"overlap\": true, \"normal\": [1]}\n"); }},
    {"number_too_large", [] { say("{\"distance\": 1e999}\n"); }},
    {"unknown_outcome", [] { say("{\"outcome\": \"perhaps\"}\n"); }},
    {"outcome_crashed", [] { say("{\"outcome\": \"crashed\"}\n"); }},
    {"a_list", [] { say("[true]\n"); }},
    {"nothing", [] { say("\n"); }},
    {"twice", [] { say("{\"overlap\":false}\n{\"overlap\":true}\n"); }},
    {"left_over_bytes", [] { say("{\"overlap\":false}\n{\"over"); }},
    {"deep", [] { say(std::string(200000, '[') + "\n"); }},
    {"deep_objects",
     [] {
       std::string s;
       for (int i = 0; i < 50000; ++i) s += "{\"a\":";
       say(s + "\n");
     }},
    {"nulls", [] { say(std::string("{\"overlap\"\0: true}\n", 19)); }},
    {"pair_of_strangers", [] { say("{\"overlap\":true,\"pairs\":[[[0,77]]]}\n"); }},
    {"pairs_of_text", [] { say("{\"overlap\":true,\"pairs\":[[[\"a\",\"b\"]]]}\n"); }},
    {"contact_of_strangers",
     [] { say("{\"contacts\":[{\"a\":0,\"b\":9,\"normal\":[0,0,1],\"depth\":1}]}\n"); }},
    {"huge_indices", [] { say("{\"pairs\":[[[99999999999999, -5]]]}\n"); }},
    {"exits", [] { _exit(0); }},
    {"exits_7", [] { _exit(7); }},
    {"aborts_in_latin1",
     [] {
       std::fputs(
           "Gr\xf6\xdf"
           "e\n",
           stderr);
       std::abort();
     }},
    {"kills_itself", [] { raise(SIGKILL); }},
    {"stops_itself", [] { raise(SIGSTOP); }},
    {"stops_its_parent",
     [] {
       kill(getppid(), SIGSTOP);
       for_ever();
     }},
    {"kills_its_parent",
     [] {
       kill(getppid(), SIGKILL);
       for_ever();
     }},
    {"spams",
     [] {
       // All at once: output after the answer is only seen with the next question.
       std::string all;
       for (int i = 0; i < 100000; ++i) all += "{\"overlap\":false}\n";
       say(all);
     }},
    {"leaves_a_child",
     [] {
       if (fork() == 0) for_ever();
     }},
    {"prints_to_stderr",
     [] {
       for (int i = 0; i < 20000; ++i)
         std::fputs("a line that nobody asked for, in the hundreds of kilobytes\n", stderr);
     }},
};

}  // namespace

int main(int, char** argv) {
  const std::string name = argv[1];
  if (const auto start = starts.find(name); start != starts.end()) start->second();
  say(card(name));
  const auto act = answers.find(name);
  bool triggered = false;
  double y = 0;
  for (std::string line; std::getline(std::cin, line);) {
    if (line.rfind("{\"scene\"", 0) == 0) {
      triggered = line.find("666.0") != std::string::npos;
      continue;
    }
    const bool is_it =
        triggered && line.find("\"a\":0") != std::string::npos && line.find("\"b\":2") != std::string::npos;
    if (is_it && act != answers.end()) act->second();
    const bool silent = is_it && name != "good" && name != "leaves_a_child" && name != "prints_to_stderr";
    if (!silent) say("{\"overlap\":false,\"distance\":" + std::to_string(y) + "}\n");
  }
}
