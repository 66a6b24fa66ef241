/// @file
/// 0/1 programs for tests and benchmarks, and answers by enumeration.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "ilp/linear_form.h"
#include "ilp/problem.h"

namespace support {

using Triangle = std::array<std::uint32_t, 3>;

/// The program that asks for a closed surface of some of these triangles
/// through all vertices: a pair for each edge, a ring for each vertex in
/// ascending order. Variable i is triangle i.
/// @param optional  vertices that the surface may leave out
ilp::Problem surface_program(std::span<const Triangle> triangles,
                             std::span<const std::uint32_t> optional = {});

/// All triangles on n vertices.
std::vector<Triangle> all_triangles(std::uint32_t n);

/// Torus grid of rows x columns vertices, both at least 3, as a closed surface.
std::vector<Triangle> torus(std::uint32_t rows, std::uint32_t columns);

/// A hole in a torus grid: the triangles with all corners in a block of
/// `size` x `size` vertices are free, and so are `extra` times as many random
/// ones on near vertices of the block; all others are fixed true.
ilp::Problem torus_hole(std::uint32_t size, double extra, std::uint64_t seed);

/// Random triangles on few vertices, at most `max_triangles`, some fixed, some
/// vertices optional, some clauses.
ilp::Problem random_surface_program(std::mt19937_64& rng,
                                    std::uint32_t max_triangles);

/// Pairs, rings and clauses without geometric sense, at most `max_variables`.
ilp::Problem random_program(std::mt19937_64& rng, std::uint32_t max_variables);

/// The same program with its variables fixed as the literals say.
ilp::Problem with_fixed(ilp::Problem problem,
                        std::span<const ilp::Literal> literals);

/// The fixed values of a program and these of its constraints alone.
ilp::Problem part_of(const ilp::Problem& problem,
                     std::span<const ilp::ConstraintId> constraints);

/// Adds the rows of a form, whose variables are the program's.
void add_rows(ilp::Problem& problem, const ilp::LinearForm& form);
/// The rows of a form, and nothing else.
ilp::Problem rows_alone(const ilp::LinearForm& form);

/// All variables in random order.
std::vector<ilp::VarId> random_order(std::mt19937_64& rng, std::size_t n);

/// By enumeration: the model that is lexicographically least in this order of
/// all variables. At most 20 that are not fixed.
std::optional<ilp::Model> least_model(const ilp::Problem& problem,
                                      std::span<const ilp::VarId> order);

}  // namespace support
