// The steps of closing by cell labels, each against enumeration or the
// certificate.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "apps/shapes.h"
#include "umbrella/cell_cut_internal.h"
#include "umbrella/certificate.h"
#include "umbrella/label_frame_internal.h"
#include "umbrella/label_mending_internal.h"
#include "umbrella/labelling_internal.h"
#include "umbrella/parity_sets_internal.h"

namespace umbrella {
namespace {

using delaunay::CellId;
using delaunay::Facet;
using delaunay::Triangulation3;

CellId cell_id(std::size_t c) { return CellId{static_cast<std::uint32_t>(c)}; }

Triangulation3 cloud(std::size_t n, std::uint64_t seed) {
  return Triangulation3(shapes::sample("uniform", n, {.seed = seed}));
}

std::vector<Facet> all_facets(const Triangulation3& t) {
  std::vector<Facet> result;
  for (std::size_t c = 0; c < t.n_finite_cells(); ++c)
    for (unsigned i = 0; i < 4; ++i)
      if (c < index(t.cell(cell_id(c)).neighbor[i].cell()))
        result.emplace_back(cell_id(c), i);
  return result;
}

CellId beyond(const Triangulation3& t, Facet f) {
  return t.cell(f.cell()).neighbor[f.index()].cell();
}

std::vector<VertexId> all_vertices(const Triangulation3& t) {
  std::vector<VertexId> all;
  for (std::uint32_t v = 0; v < t.points().size(); ++v)
    all.push_back(VertexId{v});
  return all;
}

void randomize(Labelling& labels, std::mt19937_64& rng) {
  for (std::size_t c = 0; c < labels.triangulation().n_finite_cells(); ++c)
    if (rng() % 2 == 0) labels.flip(cell_id(c));
}

/// Labels of the finite cells as the bits of a number.
void assign(Labelling& labels, std::uint32_t bits) {
  for (std::size_t c = 0; c < labels.triangulation().n_finite_cells(); ++c)
    if (labels.is_inside(cell_id(c)) != ((bits >> c & 1U) != 0))
      labels.flip(cell_id(c));
}

SurfaceReport judged(const Labelling& labels) {
  std::vector<IndexedTriangle> triangles;
  for (const LocatedTriangle& t : labels.surface())
    triangles.push_back({static_cast<std::uint32_t>(t.corners[0]),
                         static_cast<std::uint32_t>(t.corners[1]),
                         static_cast<std::uint32_t>(t.corners[2])});
  return check_surface(labels.triangulation().points(), triangles);
}

TEST(ParitySets, KnowTheParityOfEveryPathOfRelations) {
  std::mt19937_64 rng(3);
  for (int trial = 0; trial < 100; ++trial) {
    const std::size_t n = 2 + rng() % 40;
    std::vector<std::uint32_t> truth(n);
    for (auto& t : truth) t = rng() % 2;
    ParitySets sets(n);
    for (std::size_t k = 0; k < 2 * n; ++k) {
      const std::size_t a = rng() % n, b = rng() % n;
      EXPECT_TRUE(sets.relate(a, b, truth[a] ^ truth[b]));
      if (a != b) {
        EXPECT_FALSE(sets.relate(b, a, truth[a] ^ truth[b] ^ 1U));
      }
      EXPECT_EQ(sets.find(a).root, sets.find(b).root);
    }
  }
}

TEST(Labelling, HasFaultsWhereTheCertificateSaysSo) {
  for (std::uint64_t trial = 0; trial < 200; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    std::mt19937_64 rng(trial);
    const Triangulation3 t = cloud(5 + rng() % 8, trial);
    Labelling labels(t);
    randomize(labels, rng);
    const SurfaceReport report = judged(labels);
    std::size_t n_faulty = 0, n_unused = 0;
    StarParts parts;
    for (const VertexId v : all_vertices(t)) {
      labels.find_parts(v, parts);
      n_faulty += parts.n_faults() > 0 ? 1 : 0;
      n_unused += labels.is_used(v) ? 0 : 1;
      EXPECT_EQ(labels.is_used(v), parts.size() > 1);
    }
    EXPECT_EQ(n_faulty, report.nonmanifold_vertices);
    EXPECT_EQ(labels.faulty_vertices().size(), n_faulty);
    EXPECT_EQ(n_unused, report.unused_vertices.size());
    EXPECT_EQ(report.boundary_edges, 0U);
  }
}

TEST(Labelling, ListsAllFaultyVertices) {
  std::size_t n_faulty = 0, n_sound = 0;
  for (std::uint64_t trial = 0; trial < 100; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    std::mt19937_64 rng(trial);
    const Triangulation3 t = cloud(60, trial);
    Labelling labels(t);
    for (int n = 0; n < 40; ++n)
      labels.flip(cell_id(rng() % t.n_finite_cells()));
    std::vector<VertexId> expected;
    StarParts parts;
    for (const VertexId v : all_vertices(t)) {
      labels.find_parts(v, parts);
      if (parts.n_faults() > 0)
        expected.push_back(v);
      else
        n_sound += labels.is_used(v) ? 1 : 0;
    }
    EXPECT_EQ(labels.faulty_vertices(), expected);
    n_faulty += expected.size();
  }
  EXPECT_GT(n_faulty, 1000U);
  EXPECT_GT(n_sound, 1000U);
}

TEST(Labelling, KnowsWhichEdgesAreOnTheSurface) {
  std::mt19937_64 rng(5);
  const Triangulation3 t = cloud(12, 5);
  Labelling labels(t);
  for (int trial = 0; trial < 20; ++trial) {
    randomize(labels, rng);
    const auto surface = labels.surface();
    for (std::size_t c = 0; c < t.n_finite_cells(); ++c)
      for (unsigned i = 0; i < 4; ++i)
        for (unsigned k = 0; k < 4; ++k) {
          if (i == k) continue;
          const VertexId a = t.cell(cell_id(c)).vertex[i];
          const VertexId b = t.cell(cell_id(c)).vertex[k];
          const bool is_used = std::ranges::any_of(
              surface, [&](const LocatedTriangle& triangle) {
                const auto& corners = triangle.corners;
                return std::ranges::count(corners, a) > 0 &&
                       std::ranges::count(corners, b) > 0;
              });
          EXPECT_EQ(labels.is_edge_used(cell_id(c), i, k), is_used);
        }
  }
}

/// Sets of few cells.
template <class Visit>
void for_each_small_cloud(std::size_t n_sets, Visit visit) {
  for (std::uint64_t seed = 0; n_sets > 0; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 rng(seed);
    const Triangulation3 t = cloud(5 + seed % 3, seed);
    if (t.n_finite_cells() > 11) continue;
    --n_sets;
    visit(t, rng);
  }
}

/// Weights of the triangles that are not kept, the worst first.
std::vector<double> worst_first(const LabelFrame& frame,
                                const Labelling& labels,
                                std::span<const Facet> facets) {
  std::vector<double> weights;
  for (const Facet f : facets)
    if (labels.is_on_surface(f) && !frame.is_kept(f))
      weights.push_back(frame.badness(f));
  std::ranges::sort(weights, std::greater<>());
  return weights;
}

TEST(LabelWorstFirst, IsTheLeastOfAllThatKeepTheSame) {
  for_each_small_cloud(60, [](const Triangulation3& t, std::mt19937_64& rng) {
    const auto facets = all_facets(t);
    std::vector<LocatedTriangle> kept;
    for (const Facet f : facets)
      if (rng() % 6 == 0) kept.push_back({umbrella::corners(t, f), f});
    const auto open = all_vertices(t);
    const LabelFrame frame(t, CloseWeight::Circumradius, kept, open);
    Labelling labels(t);
    label_worst_first(frame, kept, labels);
    const auto holds = [&](const Labelling& l, const LocatedTriangle& k) {
      return l.is_on_surface(k.facet);
    };
    if (kept.empty()) return;
    const auto found = worst_first(frame, labels, facets);
    Labelling other(t);
    for (std::uint32_t bits = 0; bits < 1U << t.n_finite_cells(); ++bits) {
      assign(other, bits);
      if (std::ranges::all_of(kept, [&](const LocatedTriangle& k) {
            return holds(other, k) == holds(labels, k);
          })) {
        EXPECT_LE(found, worst_first(frame, other, facets));
      }
    }
  });
}

/// Random costs of facets and cells; what labels cost.
struct CutProblem {
  const Triangulation3& t;
  std::vector<CellId> cells;
  std::vector<Facet> facets;
  std::vector<CellCut::Cost> cost, preference;

  CutProblem(const Triangulation3& triangulation, std::mt19937_64& rng)
      : t(triangulation), facets(all_facets(triangulation)) {
    for (std::size_t c = 0; c < t.n_finite_cells(); ++c)
      cells.push_back(cell_id(c));
    std::shuffle(cells.begin(), cells.end(), rng);
    for (std::size_t i = 0; i < facets.size(); ++i)
      cost.push_back(static_cast<CellCut::Cost>(rng() % 20));
    for (std::size_t c = 0; c < t.n_finite_cells(); ++c) {
      preference.push_back(static_cast<CellCut::Cost>(rng() % 61) - 25);
      if (rng() % 8 == 0) preference.back() = CellCut::kInfinite / 1024;
    }
  }

  CellCut solved() const {
    CellCut cut(t, cells);
    for (std::size_t i = 0; i < facets.size(); ++i) {
      if (t.cell(beyond(t, facets[i])).is_infinite())
        cut.add_preference(facets[i].cell(), -cost[i]);
      else
        cut.set_cost(facets[i], cost[i]);
    }
    for (std::size_t c = 0; c < preference.size(); ++c)
      cut.add_preference(cell_id(c), preference[c]);
    EXPECT_TRUE(cut.run(std::numeric_limits<std::uint64_t>::max()));
    return cut;
  }

  template <class IsInside>
  CellCut::Cost total(IsInside is_inside) const {
    CellCut::Cost sum = 0;
    for (std::size_t c = 0; c < preference.size(); ++c)
      if (!is_inside(cell_id(c))) sum += preference[c];
    for (std::size_t i = 0; i < facets.size(); ++i) {
      const CellId other = beyond(t, facets[i]);
      const bool is_other_inside =
          !t.cell(other).is_infinite() && is_inside(other);
      if (is_inside(facets[i].cell()) != is_other_inside) sum += cost[i];
    }
    return sum;
  }
};

TEST(CellCut, IsTheCheapestOfAll) {
  for_each_small_cloud(150, [](const Triangulation3& t, std::mt19937_64& rng) {
    const CutProblem problem(t, rng);
    const CellCut cut = problem.solved();
    const auto found =
        problem.total([&](CellId c) { return cut.is_inside(c); });
    for (std::uint32_t bits = 0; bits < 1U << t.n_finite_cells(); ++bits)
      EXPECT_LE(found, problem.total([&](CellId c) {
        return (bits >> index(c) & 1U) != 0;
      }));
  });
}

/// Flow from cell to cell along shortest ways, until there is none.
class PlainFlow {
 public:
  explicit PlainFlow(const CutProblem& problem)
      : source_(problem.t.cells().size()),
        sink_(source_ + 1),
        left_(sink_ + 1, std::vector<CellCut::Cost>(sink_ + 1)) {
    for (std::size_t i = 0; i < problem.facets.size(); ++i) {
      const Facet f = problem.facets[i];
      const auto beyond = problem.t.cell(f.cell()).neighbor[f.index()].cell();
      left_[index(f.cell())][index(beyond)] += problem.cost[i];
      left_[index(beyond)][index(f.cell())] += problem.cost[i];
    }
    for (std::size_t c = 0; c < source_; ++c) {
      const CellCut::Cost p = c < problem.preference.size()
                                  ? problem.preference[c]
                                  : -CellCut::kInfinite;
      (p > 0 ? left_[source_][c] : left_[c][sink_]) += p > 0 ? p : -p;
    }
  }

  /// Cells that the source still reaches.
  std::vector<bool> run() {
    while (true) {
      std::vector<std::size_t> from(left_.size(), left_.size());
      std::vector<std::size_t> queue = {source_};
      from[source_] = source_;
      for (std::size_t next = 0; next < queue.size(); ++next)
        for (std::size_t k = 0; k < left_.size(); ++k)
          if (left_[queue[next]][k] > 0 && from[k] == left_.size()) {
            from[k] = queue[next];
            queue.push_back(k);
          }
      if (from[sink_] == left_.size()) return reached(from);
      CellCut::Cost flow = CellCut::kInfinite;
      for (std::size_t k = sink_; k != source_; k = from[k])
        flow = std::min(flow, left_[from[k]][k]);
      for (std::size_t k = sink_; k != source_; k = from[k]) {
        left_[from[k]][k] -= flow;
        left_[k][from[k]] += flow;
      }
    }
  }

 private:
  std::vector<bool> reached(const std::vector<std::size_t>& from) const {
    std::vector<bool> result;
    for (const std::size_t f : from) result.push_back(f != left_.size());
    return result;
  }

  std::size_t source_, sink_;
  std::vector<std::vector<CellCut::Cost>> left_;
};

TEST(CellCut, CostsNoMoreThanAPlainMaximumFlow) {
  for (std::uint64_t trial = 0; trial < 30; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    std::mt19937_64 rng(trial);
    const Triangulation3 t = cloud(10 + rng() % 25, trial);
    const CutProblem problem(t, rng);
    const CellCut cut = problem.solved();
    const auto reached = PlainFlow(problem).run();
    EXPECT_EQ(problem.total([&](CellId c) { return cut.is_inside(c); }),
              problem.total([&](CellId c) { return reached[index(c)]; }));
  }
}

TEST(CellCut, StopsWhenItsEffortIsSpent) {
  const Triangulation3 t = cloud(200, 1);
  std::mt19937_64 rng(1);
  CellCut cut(t, CutProblem(t, rng).cells);
  cut.add_preference(CellId{0}, 100);
  cut.add_preference(CellId{1}, -100);
  EXPECT_FALSE(cut.run(0));
}

/// What labels of the open cells cost: a triangle on the surface its weight,
/// unless it is kept, and a kept one of the first surface its weight for each
/// open cell at it that has another label than at first.
double cost_of_labels(const LabelFrame& frame, const Labelling& first,
                      const Labelling& labels) {
  double sum = 0;
  for (const Facet f : all_facets(frame.triangulation())) {
    if (!frame.is_kept(f)) {
      sum += labels.is_on_surface(f) ? frame.weight(f) : 0;
      continue;
    }
    if (!first.is_on_surface(f)) continue;
    for (const CellId c : {f.cell(), beyond(frame.triangulation(), f)})
      if (labels.is_inside(c) != first.is_inside(c)) sum += frame.weight(f);
  }
  return sum;
}

bool agree_where_closed(const LabelFrame& frame, const Labelling& a,
                        const Labelling& b) {
  for (std::size_t c = 0; c < frame.triangulation().n_finite_cells(); ++c)
    if (!frame.is_open(cell_id(c)) &&
        a.is_inside(cell_id(c)) != b.is_inside(cell_id(c)))
      return false;
  return true;
}

/// The kept triangles of the cheapest labels, by enumeration.
std::vector<LocatedTriangle> held_by_cheapest(
    const LabelFrame& frame, const std::vector<LocatedTriangle>& kept,
    const Labelling& first) {
  const Triangulation3& t = frame.triangulation();
  Labelling labels(t);
  double least = std::numeric_limits<double>::infinity();
  std::vector<LocatedTriangle> held;
  for (std::uint32_t bits = 0; bits < 1U << t.n_finite_cells(); ++bits) {
    assign(labels, bits);
    if (!agree_where_closed(frame, first, labels)) continue;
    const double cost = cost_of_labels(frame, first, labels);
    if (cost >= least) continue;
    least = cost;
    held = kept;
    std::erase_if(held, [&](const LocatedTriangle& triangle) {
      return !labels.is_on_surface(triangle.facet);
    });
  }
  return held;
}

TEST(HeldByCut, AreKeptTrianglesOfTheCheapestLabels) {
  std::size_t n_held = 0, n_given_up = 0;
  for_each_small_cloud(150, [&](const Triangulation3& t, std::mt19937_64& rng) {
    auto open = all_vertices(t);
    std::shuffle(open.begin(), open.end(), rng);
    open.resize(4 + rng() % (open.size() - 3));
    std::vector<LocatedTriangle> kept;
    for (const Facet f : all_facets(t))
      if (rng() % 3 == 0) kept.push_back({umbrella::corners(t, f), f});
    const LabelFrame frame(t, CloseWeight::Circumradius, kept, open);
    Labelling first(t);
    label_worst_first(frame, kept, first);

    const auto held = held_by_cut(frame, kept, first);
    const auto expected = held_by_cheapest(frame, kept, first);
    ASSERT_EQ(held.size(), expected.size());
    for (std::size_t i = 0; i < held.size(); ++i)
      EXPECT_EQ(held[i].corners, expected[i].corners);
    n_held += held.size();
    n_given_up += kept.size() - held.size();
  });
  EXPECT_GT(n_held, 100U);
  EXPECT_GT(n_given_up, 100U);
}

TEST(LabelMending, MendsAnyLabels) {
  for (std::uint64_t trial = 0; trial < 60; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    std::mt19937_64 rng(trial);
    const Triangulation3 t = cloud(5 + rng() % 60, trial);
    auto open = all_vertices(t);
    std::shuffle(open.begin(), open.end(), rng);
    open.resize(rng() % (open.size() + 1));
    LabelFrame frame(t, CloseWeight::Circumradius, {}, open);
    Labelling labels(t);
    randomize(labels, rng);
    LabelMending(frame, labels).run();
    EXPECT_EQ(judged(labels).nonmanifold_vertices, 0U);
    EXPECT_EQ(judged(labels).nonmanifold_edges, 0U);
    EXPECT_EQ(LabelMending(frame, labels).run(), 0U);
  }
}

/// Two cells at one edge and a third between them: to switch one of the two off
/// would lose points, to join them does not.
TEST(LabelMending, JoinsPartsRatherThanLosePoints) {
  const Triangulation3 t = cloud(60, 1);
  const auto all = all_vertices(t);
  std::size_t n_joined = 0;
  for (std::size_t c = 0; c < t.n_finite_cells(); ++c) {
    const auto& around = t.cell(cell_id(c)).neighbor;
    const CellId a = around[c % 4].cell(), b = around[(c + 1) % 4].cell();
    const auto& beside_a = t.cell(a).neighbor;
    if (t.cell(a).is_infinite() || t.cell(b).is_infinite() ||
        std::any_of(beside_a.begin(), beside_a.end(),
                    [b](Facet f) { return f.cell() == b; }))
      continue;
    SCOPED_TRACE(testing::Message() << "cell " << c);
    LabelFrame frame(t, CloseWeight::Circumradius, {}, all);
    Labelling labels(t);
    labels.flip(a);
    labels.flip(b);
    EXPECT_EQ(LabelMending(frame, labels).run(), 2U);
    EXPECT_EQ(judged(labels).nonmanifold_vertices, 0U);
    for (const CellId end : {a, b})
      for (const VertexId v : t.cell(end).vertex)
        EXPECT_TRUE(labels.is_used(v));
    ++n_joined;
  }
  EXPECT_GT(n_joined, 50U);
}

}  // namespace
}  // namespace umbrella
