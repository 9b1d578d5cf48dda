// touchstone cover: its verdicts, exit codes and messages.
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/catch.h"
#include "tests/support/parsed.h"
#include "tests/support/workspace.h"

using touchstone::test::read_all;
using touchstone::test::Workspace;

namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// A box as an object of an OBJ file; `first` is the number of its first vertex.
std::string box(const std::string& name, double x0, double x1, double height, int first) {
  std::string s = "o " + name + "\n";
  for (const double x : {x0, x1})
    for (const double y : {0.0, 1.0})
      for (const double z : {0.0, height})
        s += "v " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
  for (const auto& f :
       {std::array{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}}) {
    s += "f";
    for (const int i : f) s += " " + std::to_string(first + i);
    s += "\n";
  }
  return s;
}

}  // namespace

TEST_CASE("cover says whether pieces contain a mesh, and by how much not", "[cli][cover]") {
  const Workspace w("cover");
  w.write("mesh.obj", box("block", 0, 1, 1, 1));
  w.write("two.obj", box("left", 0, 0.5, 1, 1) + box("right", 0.5, 1, 1, 9));
  w.write("low.obj", box("left", 0, 0.5, 1, 1) + box("right", 0.5, 1, 0.75, 9));
  const auto yes = w.touchstone("cover mesh.obj two.obj -o two.json");
  INFO(yes.out << yes.err);
  CHECK(yes.code == 0);
  CHECK(has(yes.out, "by 2 convex pieces"));
  CHECK(has(yes.out, "yes: every point of 12 triangles"));
  CHECK(has(yes.out, "exit code 0 is about two.obj: it covers the mesh"));
  const auto j = touchstone::test::parsed<nlohmann::json>(read_all(w.dir / "two.json"));
  CHECK(j["covers"] == true);
  CHECK(j["mesh_volume"] == 1);
  const auto no = w.touchstone("cover mesh.obj low.obj");
  CHECK(no.code == 1);
  CHECK(has(no.out, "have points in no piece"));
  CHECK(has(no.out, "sticks out"));
  const auto missed =
      touchstone::test::parsed<nlohmann::json>(w.touchstone("cover mesh.obj low.obj --json").out);
  CHECK(missed["sticks_out"]["distance"][0].get<double>() <= 0.25);
  CHECK(missed["sticks_out"]["distance"][1].get<double>() >= 0.25);
  CHECK(missed["sticks_out"]["distance"][0].get<double>() >= 0.2475);
  CHECK(missed["excess_volume"][1].get<double>() < 0);
  for (const std::string& text : {yes.out, no.out})
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = text.find('\n', at);
      CHECK(end - at < 80);
      at = end + 1;
    }
}

TEST_CASE("cover refuses what is no mesh or no piece, by file and piece", "[cli][cover]") {
  const Workspace w("cover");
  w.write("mesh.obj", box("block", 0, 1, 1, 1));
  w.write("flat.obj", box("left", 0, 1, 1, 1) + box("sheet", 0, 1, 0, 9));
  const auto flat = w.touchstone("cover mesh.obj flat.obj");
  CHECK(flat.code == 2);
  CHECK(has(flat.err, "flat.obj: piece 1 (sheet): is flat"));
  const auto gone = w.touchstone("cover mesh.obj gone.obj");
  CHECK(gone.code == 2);
  CHECK(has(gone.err, "gone.obj"));
}
