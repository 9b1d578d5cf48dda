// A registry of packages in a folder, and a program `npm` that reads it, so that tests of engines from npm
// need no network. The packages imitate Rapier for balls alone; each release differs from the next.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "tests/support/workspace.h"

namespace touchstone::test {

/// Two balls of radius 1/2, their centres 1.75 apart: the distance is 0.75.
inline constexpr const char* two_small_balls = R"({"touchstone_case": 1, "scene": {"touchstone_scene": 1,
  "shapes": [{"type": "sphere", "radius": 0.5}],
  "bodies": [{"shape": 0}, {"shape": 0, "pose": {"translation": [1.75, 0, 0]}}]},
  "queries": [{"question": "distance", "a": 0, "b": 1}]})";

class NpmRegistry {
 public:
  /// In the folder `registry` of the workspace; `npm` appends its arguments to npm.log there.
  explicit NpmRegistry(const Workspace& w) : w_(w), folder_(w.dir / "registry") {
    std::filesystem::create_directories(folder_);
    write("npm", npm);
    std::filesystem::permissions(folder_ / "npm", std::filesystem::perms::owner_all);
    for (const auto& [release, code] : releases) {
      write("rapier3d-compat@" + release + ".mjs", code + rapier);
      names_ += names_.empty() ? "" : ", ";
      names_ += "\"" + release + "\"";
    }
    list(names_);
  }
  /// What `npm view … versions --json` prints between the brackets.
  void list(const std::string& names) const { write("versions.json", "[" + names + "]\n"); }
  const std::string& names() const { return names_; }

  /// Runs the program with this npm and an empty folder for packages.
  Run touchstone(const std::string& args) const {
    return w_.run(environment() + " " TS_BINARY_DIR "/bin/touchstone " + args);
  }
  std::string environment() const {
    return "PATH=" + folder_.string() + ":\"$PATH\" TOUCHSTONE_NPM=" + (w_.dir / "packages").string();
  }
  std::string log() const { return read_all(folder_ / "npm.log"); }

 private:
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }

  const Workspace& w_;
  std::filesystem::path folder_;
  std::string names_;

  static constexpr const char* npm = R"(#!/bin/sh
here=$(dirname "$0")
echo "$*" >>"$here/npm.log"
case $1 in
view) cat "$here/versions.json" ;;
install)
  for word; do
    case $word in
    @dimforge/rapier3d-compat@*)
      release=${word##*@}
      into=$3/node_modules/@dimforge/rapier3d-compat
      mkdir -p "$into" &&
        cp "$here/rapier3d-compat@$release.mjs" "$into/rapier.mjs" &&
        echo "{\"name\": \"rapier\", \"version\": \"$release\", \"main\": \"rapier.mjs\"}" >"$into/package.json" || exit 1 ;;
    esac
  done ;;
esac
)";

  // What is particular to a release: which functions it has, and what is wrong in it.
  static inline const std::map<std::string, std::string> releases = {
      {"0.0.9",
       "process.on('uncaughtException', (why) => { throw why; });\n"
       "throw new Error('made for browsers');\nconst has = {}, off = 0;\n"},
      {"0.1.0", "const has = {}, off = 0;\n"},
      {"0.2.0", "const has = {contact: true, cast: 8}, off = 0;\n"},
      {"0.3.0", "const has = {contact: true, cast: 9}, off = 0;\n"},
      {"0.4.0", "const has = {contact: true, cast: 10}, off = 0.25;\n"},
      {"0.5.0", "const has = {contact: true, cast: 10}, off = 0.25;\n"},
      {"0.6.0", "const has = {contact: true, cast: 10}, off = 0.25;\n"},
      {"0.6.1", "const has = {contact: true, cast: 11}, off = 0;\n"},
      {"0.7.0", "const has = {contact: true, cast: 10, per_cent: true}, off = 0;\n"},
  };

  // `off` is added to every distance of balls that are not both of radius 1.
  static constexpr const char* rapier = R"(
const minus = (p, q) => [p.x - q.x, p.y - q.y, p.z - q.z];
const dot = (v, w) => v[0] * w[0] + v[1] * w[1] + v[2] * w[2];
const xyz = ([x, y, z]) => ({x, y, z});
class Ball {
  constructor(radius) { this.radius = radius; }
}
if (has.contact) {
  Ball.prototype.intersectsShape = function (p, r, other, q, s) {
    return Math.hypot(...minus(q, p)) <= this.radius + other.radius;
  };
  Ball.prototype.contactShape = function (p, r, other, q, s, reach) {
    const way = minus(q, p), far = Math.hypot(...way), n = way.map((x) => x / far);
    const distance = far - this.radius - other.radius + (this.radius === 1 && other.radius === 1 ? 0 : off);
    if (distance > reach) return null;
    const on = (c, k) => xyz([c.x + k * n[0], c.y + k * n[1], c.z + k * n[2]]);
    return {distance, normal1: xyz(n), point1: on(p, this.radius), point2: on(q, -other.radius)};
  };
}
function cast(mine, p, v, other, q, w, latest) {
  const x = minus(q, p), u = minus(w, v), r = mine.radius + other.radius;
  const a = dot(u, u), b = dot(x, u), c = dot(x, x) - r * r, root = b * b - a * c;
  if (c <= 0) return 0;
  const t = root < 0 || a === 0 ? Infinity : (-b - Math.sqrt(root)) / a;
  return t >= 0 && t <= latest ? (has.per_cent ? 100 * t : t) : null;
}
const hit = (t, name) => (t === null ? null : {[name]: t});
const casts = {
  8: function (p, r, v, o, q, s, w, latest) { return hit(cast(this, p, v, o, q, w, latest), "toi"); },
  9: function (p, r, v, o, q, s, w, latest, stop) { return hit(cast(this, p, v, o, q, w, latest), "toi"); },
  10: function (p, r, v, o, q, s, w, near, latest, stop) {
    return hit(cast(this, p, v, o, q, w, latest), "time_of_impact");
  },
  11: function (p, r, v, o, q, s, w, near, latest, stop, into) {
    return hit(cast(this, p, v, o, q, w, latest), "time_of_impact");
  },
};
if (has.cast) Ball.prototype.castShape = casts[has.cast];
export default {init: async () => {}, Ball};
)";
};

}  // namespace touchstone::test
