// report_table RUNS.tsv: prints the tables that scripts/reproduce.sh shows.
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <stdexcept>

#include "apps/report_table.h"

namespace {

void print_tables(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::invalid_argument("cannot be read");
  const auto rows = report_table::read_rows(file);
  std::cout << "Points and triangles:\n\n"
            << report_table::counts_table(rows) << "\nSeconds:\n\n"
            << report_table::seconds_table(rows);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: report_table RUNS.tsv\n";
    return 2;
  }
  try {
    print_tables(argv[1]);
  } catch (const std::exception& error) {
    std::cerr << argv[1] << ": " << error.what() << '\n';
    return 2;
  }
  return EXIT_SUCCESS;
}
