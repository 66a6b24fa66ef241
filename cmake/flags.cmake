# What every number in the project relies on: no fused multiply-add behind our
# back, and IEEE semantics. PUBLIC, so that it reaches inline predicates too.
add_library(numerics INTERFACE)
target_compile_features(numerics INTERFACE cxx_std_20)
target_compile_options(numerics INTERFACE -ffp-contract=off)
if(CMAKE_CXX_FLAGS MATCHES "-(ffast-math|Ofast|funsafe-math-optimizations)")
  message(FATAL_ERROR "umbrella needs IEEE arithmetic: -ffast-math and its kin are refused")
endif()

add_library(warnings INTERFACE)
target_compile_options(warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  $<$<BOOL:${WARNINGS_AS_ERRORS}>:-Werror>)
