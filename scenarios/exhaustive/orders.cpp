#include "scenarios/exhaustive/suites.h"

#include <algorithm>
#include <map>

namespace touchstone::fuzz {
namespace {

// Two scales that map ranks to coordinates: the whole numbers around 0, and neighbouring numbers above 1.
constexpr std::uint64_t scales = 2;

bool is_dense(const AxisOrder& r) {
  const int top = *std::max_element(r.begin(), r.end());
  for (int k = 0; k <= top; ++k)
    if (std::find(r.begin(), r.end(), k) == r.end()) return false;
  return true;
}

std::vector<AxisOrder> make_orders(int intervals) {
  const int ends = 2 * intervals;
  std::vector<AxisOrder> all;
  AxisOrder r(static_cast<std::size_t>(ends), 0);
  for (;;) {
    bool ordered = true;
    for (std::size_t i = 0; i < r.size(); i += 2) ordered = ordered && r[i] <= r[i + 1];
    if (ordered && is_dense(r)) all.push_back(r);
    std::size_t k = 0;
    while (k < r.size() && ++r[k] == ends) r[k++] = 0;
    if (k == r.size()) return all;
  }
}

// Ends at even multiples of half a step, so that centres and half extents are representable too.
struct Span {
  double t, h;
};
Span span_of(const AxisOrder& order, std::size_t box, std::uint64_t scale, Scalar scalar) {
  const double lo = order[2 * box], hi = order[2 * box + 1];
  if (scale == 0) return {(lo + hi) / 2 - 2, (hi - lo) / 2};
  const double step = unit_in_last_place(scalar);
  return {1 + (lo + hi) * step, (hi - lo) * step};
}

void boxes_of(const std::array<const AxisOrder*, 3>& axes, std::uint64_t scale, Scalar scalar, Scene& s) {
  for (std::size_t i = 0; i < axes[0]->size() / 2; ++i) {
    Placing p;
    for (int k = 0; k < 3; ++k) {
      const Span span = span_of(*axes[static_cast<std::size_t>(k)], i, scale, scalar);
      p.t[k] = span.t;
      p.h[k] = span.h;
    }
    add_box(s, p);
  }
}

void ask(Case& c) {
  insert_all(c.scene);
  step_query(c.scene);
  c.queries = {{Question::candidates, -1, -1}};
}

AxisOrder mirrored(const AxisOrder& r) {
  const int top = *std::max_element(r.begin(), r.end());
  AxisOrder m(r.size());
  for (std::size_t i = 0; i < r.size(); i += 2) {
    m[i] = top - r[i + 1];
    m[i + 1] = top - r[i];
  }
  return m;
}

AxisOrder renamed(const AxisOrder& r, const std::array<std::size_t, 3>& names) {
  AxisOrder m(r.size());
  for (std::size_t i = 0; i < 3; ++i) {
    m[2 * names[i]] = r[2 * i];
    m[2 * names[i] + 1] = r[2 * i + 1];
  }
  return m;
}

constexpr auto renamings = std::to_array<std::array<std::size_t, 3>>(
    {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}});

// For each renaming, the image of each order: the smaller of the two reflections.
using Image = std::vector<std::array<std::uint32_t, renamings.size()>>;
Image images() {
  const auto& orders = axis_orders(3);
  std::map<AxisOrder, std::uint32_t> number;
  for (std::uint32_t i = 0; i < orders.size(); ++i) number[orders[i]] = i;
  Image image(orders.size());
  for (std::size_t i = 0; i < orders.size(); ++i)
    for (std::size_t p = 0; p < renamings.size(); ++p) {
      const AxisOrder r = renamed(orders[i], renamings[p]);
      image[i][p] = std::min(number.at(r), number.at(mirrored(r)));
    }
  return image;
}

std::uint32_t packed(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  if (a > b) std::swap(a, b);
  if (b > c) std::swap(b, c);
  if (a > b) std::swap(a, b);
  return a << 20 | b << 10 | c;
}

std::vector<std::uint32_t> make_triple_classes() {
  const Image image = images();
  const auto n = static_cast<std::uint32_t>(image.size());
  std::vector<std::uint32_t> least;  // smallest of its reflections
  for (std::uint32_t i = 0; i < n; ++i)
    if (image[i][0] == i) least.push_back(i);
  std::vector<std::uint32_t> classes;
  const auto is_least = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const std::uint32_t own = packed(a, b, c);
    for (std::size_t p = 1; p < renamings.size(); ++p)
      if (packed(image[a][p], image[b][p], image[c][p]) < own) return false;
    return true;
  };
  for (std::size_t i = 0; i < least.size(); ++i)
    for (std::size_t j = i; j < least.size(); ++j)
      for (std::size_t k = j; k < least.size(); ++k)
        if (is_least(least[i], least[j], least[k])) classes.push_back(packed(least[i], least[j], least[k]));
  return classes;
}

}  // namespace

const std::vector<AxisOrder>& axis_orders(int intervals) {
  static const std::vector<AxisOrder> two = make_orders(2), three = make_orders(3);
  return intervals == 2 ? two : three;
}

const std::vector<std::uint32_t>& triple_classes() {
  static const std::vector<std::uint32_t> all = make_triple_classes();
  return all;
}

std::uint64_t count_orders_of_two(const Draw&) {
  const auto n = axis_orders(2).size();
  return n * n * n * scales;
}

void orders_of_two(const Draw& d, std::uint64_t index, Case& out) {
  const auto& orders = axis_orders(2);
  const std::uint64_t scale = index % scales, n = orders.size();
  index /= scales;
  boxes_of({&orders[index % n], &orders[index / n % n], &orders[index / n / n]}, scale, d.scalar, out.scene);
  ask(out);
}

std::uint64_t count_orders_on_an_axis(const Draw&) { return axis_orders(3).size() * 3 * scales; }

// On the other two axes all three boxes overlap.
void orders_on_an_axis(const Draw& d, std::uint64_t index, Case& out) {
  static const AxisOrder same{0, 1, 0, 1, 0, 1};
  const auto& orders = axis_orders(3);
  std::array<const AxisOrder*, 3> axes{&same, &same, &same};
  axes[index % 3] = &orders[index / 3 / scales];
  boxes_of(axes, index / 3 % scales, d.scalar, out.scene);
  ask(out);
}

std::uint64_t count_orders_of_three(const Draw&) { return triple_classes().size(); }

// Draws one member of each class: a subject need not have the symmetries.
void orders_of_three(const Draw& d, std::uint64_t index, Case& out) {
  Rng rng = Rng::stream(d.seed, index);
  const std::uint32_t code = triple_classes()[index];
  const auto& orders = axis_orders(3);
  const auto& names = renamings[rng.below(6)];
  const auto& places = renamings[rng.below(6)];
  std::array<AxisOrder, 3> drawn;
  for (std::size_t k = 0; k < 3; ++k) {
    const AxisOrder& r = orders[code >> (10 * k) & 1023];
    drawn[places[k]] = renamed(rng.chance(0.5) ? mirrored(r) : r, names);
  }
  boxes_of({&drawn[0], &drawn[1], &drawn[2]}, rng.below(scales), d.scalar, out.scene);
  ask(out);
}

}  // namespace touchstone::fuzz
