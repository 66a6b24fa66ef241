// Curve reconstructions against the truth: curves [--seed S] [--each N]
// [--coast FOLDER] [--csv FILE]. Prints, for each group of instances, the share
// of instances that each method gets exactly right, then precision, recall and
// time over all. FOLDER holds what scripts/fetch_coastlines.sh leaves; without
// it the group is left out with a notice.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "bench/coastlines.h"
#include "tests/support/curve_instances.h"
#include "umbrella/curve.h"
#include "umbrella/curve_baselines.h"
#include "umbrella/plane_complexes.h"

namespace {

using tests::CurveEdge;
using tests::CurveInstance;
using umbrella::CurveMode;

struct Method {
  std::string name;
  std::function<std::vector<CurveEdge>(const CurveInstance&)> edges;
  bool one_closed_curve = false;  ///< all it can make
};

Method ours(const std::string& name, CurveMode mode) {
  return {name,
          [mode](const CurveInstance& instance) {
            return umbrella::reconstruct_curve(instance.points, {.mode = mode})
                .edges;
          },
          mode == CurveMode::Tour};
}

template <class Baseline>
Method theirs(const std::string& name, Baseline baseline) {
  return {name,
          [baseline](const CurveInstance& instance) {
            const delaunay::Triangulation2 t(instance.points);
            std::vector<std::uint32_t> row(t.points().size());
            for (std::uint32_t i = 0; i < t.vertex_of_row().size(); ++i)
              row[index(t.vertex_of_row()[i])] = i;
            std::vector<CurveEdge> edges;
            for (const auto& [v, w] : baseline(t))
              edges.push_back({row[index(v)], row[index(w)]});
            return edges;
          },
          false};
}

std::vector<Method> methods() {
  using delaunay::Triangulation2;
  return {ours("auto", CurveMode::Auto),
          ours("paper", CurveMode::Paper),
          ours("closed", CurveMode::Closed),
          ours("open", CurveMode::Open),
          ours("tsp", CurveMode::Tour),
          ours("mutual", CurveMode::Mutual),
          theirs("Crust", umbrella::crust),
          theirs("NN-Crust", umbrella::nn_crust),
          theirs("HNN-Crust", umbrella::hnn_crust),
          theirs("beta 1.2",
                 [](const Triangulation2& t) {
                   return umbrella::beta_skeleton(t, 1.2);
                 }),
          theirs("Gabriel", umbrella::gabriel_complex)};
}

/// What a method made of the instances of a group.
struct Score {
  std::size_t instances = 0, exact = 0;
  std::size_t found = 0, right = 0, wanted = 0;  // edges
  double seconds = 0;

  void add(const Score& other) {
    instances += other.instances;
    exact += other.exact;
    found += other.found;
    right += other.right;
    wanted += other.wanted;
    seconds += other.seconds;
  }
};

double part(std::size_t a, std::size_t b) {
  return b == 0 ? 0 : 100.0 * static_cast<double>(a) / static_cast<double>(b);
}

Score score(const Method& method, const CurveInstance& instance) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  std::vector<CurveEdge> edges = method.edges(instance);
  const std::chrono::duration<double> seconds = Clock::now() - start;
  edges = tests::in_order(std::move(edges));
  std::vector<CurveEdge> right;
  std::ranges::set_intersection(edges, instance.truth,
                                std::back_inserter(right));
  return {1,
          edges == instance.truth ? 1U : 0U,
          edges.size(),
          right.size(),
          instance.truth.size(),
          seconds.count()};
}

struct Group {
  std::string name;
  bool is_clean = true;
  std::size_t n_drawn = 0;
  std::vector<CurveInstance> instances;  // whose true edges are all Delaunay
};

void take(Group& group, std::vector<CurveInstance> instances) {
  for (CurveInstance& instance : instances) {
    ++group.n_drawn;
    if (tests::truth_is_delaunay(instance))
      group.instances.push_back(std::move(instance));
  }
}

struct Options {
  std::uint64_t seed = 1;
  std::uint64_t each = 100;
  std::string coast;
  std::string csv;
};

std::vector<Group> groups(const Options& options) {
  std::vector<Group> all;
  for (const bool clean : {true, false}) {
    for (const std::string_view name :
         clean ? tests::clean_curve_groups() : tests::spoilt_curve_groups()) {
      Group& group = all.emplace_back();
      group.name = name;
      group.is_clean = clean;
      std::vector<CurveInstance> instances;
      for (std::uint64_t i = 0; i < options.each; ++i)
        instances.push_back(
            tests::make_curve_instance(name, options.seed * 1'000'000 + i));
      take(group, std::move(instances));
    }
  }
  // Odd seeds take odd rings, even seeds even ones; of many rings, some.
  for (const char* map : {"land-110m", "land-50m", "land-10m"}) {
    const auto rings =
        bench::coastlines(options.coast + "/" + map + ".xyz", 20, 1000);
    if (rings.empty()) {
      std::cerr << map << ": left out, not in --coast\n";
      continue;
    }
    std::vector<CurveInstance> some;
    const std::size_t stride = 2 * (1 + rings.size() / (4 * options.each));
    for (std::size_t i = options.seed % 2; i < rings.size(); i += stride)
      some.push_back(rings[i]);
    take(all.emplace_back(Group{map, true, 0, {}}), std::move(some));
  }
  return all;
}

void print_row(const std::string& first, const std::vector<std::string>& rest) {
  std::cout << "| " << first;
  for (const std::string& cell : rest) std::cout << " | " << cell;
  std::cout << " |\n";
}

std::string one_digit(double x) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.1f", x);
  return text.data();
}

using Table = std::vector<std::vector<Score>>;  // group, method

void print(const std::vector<Group>& all, const std::vector<Method>& by,
           const Table& table) {
  std::vector<std::string> names = {"instances", "all Delaunay"};
  for (const Method& method : by) names.push_back(method.name);
  print_row("group", names);
  print_row("---", std::vector<std::string>(names.size(), "---"));
  std::vector<Score> clean(by.size());
  for (std::size_t g = 0; g < all.size(); ++g) {
    std::vector<std::string> cells = {std::to_string(all[g].n_drawn),
                                      std::to_string(all[g].instances.size())};
    for (std::size_t m = 0; m < by.size(); ++m) {
      const Score& s = table[g][m];
      cells.push_back(s.instances == 0 ? "-"
                                       : one_digit(part(s.exact, s.instances)));
      if (all[g].is_clean) clean[m].add(s);
    }
    print_row(all[g].name, cells);
  }
  const auto line = [&](const std::string& name, const auto& value) {
    std::vector<std::string> cells = {"", ""};
    for (const Score& s : clean) cells.push_back(one_digit(value(s)));
    print_row(name, cells);
  };
  line("clean, exact %",
       [](const Score& s) { return part(s.exact, s.instances); });
  line("clean, precision %",
       [](const Score& s) { return part(s.right, s.found); });
  line("clean, recall %",
       [](const Score& s) { return part(s.right, s.wanted); });
  line("clean, ms an instance", [](const Score& s) {
    return 1e3 * s.seconds / static_cast<double>(s.instances);
  });
}

void write_csv(const std::string& path, const std::vector<Group>& all,
               const std::vector<Method>& by, const Table& table) {
  std::ofstream out(path);
  out << "group,method,instances,exact,edges,right,true_edges,seconds\n";
  for (std::size_t g = 0; g < all.size(); ++g)
    for (std::size_t m = 0; m < by.size(); ++m) {
      const Score& s = table[g][m];
      out << all[g].name << ',' << by[m].name << ',' << s.instances << ','
          << s.exact << ',' << s.found << ',' << s.right << ',' << s.wanted
          << ',' << s.seconds << '\n';
    }
}

Options parse(int argc, char** argv) {
  Options options;
  const std::map<std::string, std::function<void(const std::string&)>> known = {
      {"--seed", [&](const auto& x) { options.seed = std::stoull(x); }},
      {"--each", [&](const auto& x) { options.each = std::stoull(x); }},
      {"--coast", [&](const auto& x) { options.coast = x; }},
      {"--csv", [&](const auto& x) { options.csv = x; }}};
  for (int i = 1; i + 1 < argc; i += 2) known.at(argv[i])(argv[i + 1]);
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  const Options options = parse(argc, argv);
  const std::vector<Group> all = groups(options);
  const std::vector<Method> by = methods();
  Table table(all.size(), std::vector<Score>(by.size()));
  for (std::size_t g = 0; g < all.size(); ++g)
    for (const CurveInstance& instance : all[g].instances)
      for (std::size_t m = 0; m < by.size(); ++m)
        if (instance.one_closed_curve || !by[m].one_closed_curve)
          table[g][m].add(score(by[m], instance));
  print(all, by, table);
  if (!options.csv.empty()) write_csv(options.csv, all, by, table);
}
