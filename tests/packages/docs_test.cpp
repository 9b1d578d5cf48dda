// `./touchstone docs`: every document becomes a page, and every link in the pages leads somewhere.
#include <filesystem>
#include <string>

#include "tests/support/catch.h"
#include "tests/support/skip.h"
#include "tests/support/workspace.h"

using touchstone::test::has_command;
using touchstone::test::Run;
using touchstone::test::Workspace;
namespace fs = std::filesystem;

namespace {

// Prints the links of the documents' pages to files or headings that do not exist, and how many were checked.
constexpr const char* check_links = R"(
import html.parser, pathlib, sys, urllib.parse

class Page(html.parser.HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.links, self.names = [], {''}
        self.feed(path.read_text())
    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ('href', 'src', 'srcset') and value:
                self.links.append(value)
            if name in ('id', 'name'):
                self.names.add(value)

root = pathlib.Path(sys.argv[1]).resolve()
pages = {p: Page(p) for p in root.rglob('*.html') if p.name != '404.html' and root / 'api' not in p.parents}
checked = 0
for path, page in pages.items():
    for link in page.links:
        url = urllib.parse.urlsplit(link)
        if url.scheme or url.netloc:
            continue
        target = (path.parent / urllib.parse.unquote(url.path)).resolve() if url.path else path
        if target.is_dir():
            target = target / 'index.html'
        checked += 1
        if not target.exists():
            print(f'{path.relative_to(root)}: {link}: no such file')
        elif target in pages and urllib.parse.unquote(url.fragment) not in pages[target].names:
            print(f'{path.relative_to(root)}: {link}: no such heading')
print(len(pages), 'pages,', 'enough' if checked > 500 else 'few', 'links')
)";

std::string launcher(const std::string& arguments) { return TS_SOURCE_DIR "/touchstone docs " + arguments; }

}  // namespace

TEST_CASE("the documents as HTML are complete and all their links lead somewhere", "[packages][optional]") {
  if (!has_command("mkdocs") || !has_command("python3"))
    return touchstone::test::skip("mkdocs or python3 is not installed");
  const Workspace w("docs");
  const Run made = w.run(launcher("-o html"));
  INFO(made.out << made.err);
  REQUIRE(made.code == 0);
  std::size_t documents = 3;  // README.md, CONTRIBUTING.md, corpus/README.md
  for (const auto& entry : fs::recursive_directory_iterator(TS_SOURCE_DIR "/docs"))
    if (entry.path().extension() == ".md") ++documents;
  documents += 1;  // corpus/CHANGELOG.md
  w.write("check.py", check_links);
  const Run links = w.run("python3 check.py html");
  INFO(links.err);
  CHECK(links.out == std::to_string(documents) + " pages, enough links\n");

  if (has_command("doxygen")) {
    const std::string functions = touchstone::test::read_all(w.dir / "html/api/touchstone_8h.html");
    for (const char* words : {"touchstone_gap", "The convex hull of n points, 3 doubles each."})
      CHECK(functions.find(words) != std::string::npos);
    CHECK(touchstone::test::read_all(w.dir / "html/index.html").find("api/index.html") != std::string::npos);
  }

  CHECK(w.run(launcher("-o html")).code == 0);  // its own directory is written again
}

TEST_CASE("docs refuses bad options and directories that it did not write", "[packages][optional]") {
  const Workspace w("docs-refused");
  CHECK(w.run(launcher("")).code == 2);
  CHECK(w.run(launcher("-o")).code == 2);
  CHECK(w.run(launcher("--fast -o html")).code == 2);
  w.write("file", "text");
  CHECK(w.run(launcher("-o file")).code == 2);
  const Run refused = w.run(launcher("-o ."));
  CHECK(refused.code == 2);
  CHECK(refused.err.find("not written by this command") != std::string::npos);
  CHECK(fs::exists(w.dir / "file"));
}

TEST_CASE("the page of each engine is what docs/engine_pages.py writes", "[packages][optional]") {
  for (const char* plugin : {"fcl", "bullet_f64", "libccd", "ode"})
    if (!fs::exists(TS_BINARY_DIR "/lib/libtouchstone_" + std::string(plugin) + ".so"))
      return touchstone::test::skip(std::string(plugin) + " is not built");
  if (!has_command("python3")) return touchstone::test::skip("python3 is not installed");
  const Workspace w("engine-pages");
  const Run made =
      w.run("TOUCHSTONE_ENGINES=none " TS_BINARY_DIR "/bin/touchstone engines --json | python3 " TS_SOURCE_DIR
            "/docs/engine_pages.py pages");
  INFO(made.err);
  REQUIRE(made.code == 0);
  std::size_t compared = 0;
  for (const auto& entry : fs::directory_iterator(w.dir / "pages")) {
    const fs::path stored = fs::path(TS_SOURCE_DIR "/docs/engines") / entry.path().filename();
    INFO(stored << ": ./touchstone engines --json | docs/engine_pages.py");
    CHECK(touchstone::test::read_all(stored) == touchstone::test::read_all(entry.path()));
    ++compared;
  }
  CHECK(compared == 10);
  for (const auto& entry : fs::directory_iterator(TS_SOURCE_DIR "/docs/engines"))
    CHECK(fs::exists(w.dir / "pages" / entry.path().filename()));
}
