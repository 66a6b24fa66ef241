# What tests and benchmarks of ilp share: programs, and other solvers where
# installed (targets clause_peer and cbc_peer; none is needed).
if(TARGET ilp_programs)
  return()
endif()

function(ilp_support name)
  set(sources ${ARGN})
  list(TRANSFORM sources PREPEND ${PROJECT_SOURCE_DIR}/tests/support/)
  add_library(${name} ${sources})
  target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PUBLIC ilp PRIVATE warnings)
endfunction()

ilp_support(ilp_programs ilp_programs.cpp)
ilp_support(hole_programs hole_programs.cpp)
target_link_libraries(hole_programs PUBLIC umbrella PRIVATE shapes)

find_path(CADICAL_INCLUDE_DIR cadical.hpp)
find_library(CADICAL_LIBRARY cadical)
if(CADICAL_INCLUDE_DIR AND CADICAL_LIBRARY)
  ilp_support(clause_peer clause_peer.cpp)
  target_include_directories(clause_peer SYSTEM
    PRIVATE ${CADICAL_INCLUDE_DIR})
  target_link_libraries(clause_peer PRIVATE ${CADICAL_LIBRARY})
else()
  message(STATUS "CaDiCaL not found: the solver runs without that peer")
endif()

find_path(CBC_INCLUDE_DIR coin/Cbc_C_Interface.h)
find_library(CBC_LIBRARY Cbc)
find_library(CBC_SOLVER_LIBRARY CbcSolver)
if(CBC_INCLUDE_DIR AND CBC_LIBRARY AND CBC_SOLVER_LIBRARY)
  ilp_support(cbc_peer cbc_peer.cpp)
  target_include_directories(cbc_peer SYSTEM PRIVATE ${CBC_INCLUDE_DIR})
  target_link_libraries(cbc_peer PRIVATE ${CBC_SOLVER_LIBRARY} ${CBC_LIBRARY})
else()
  message(STATUS "CBC not found: the solver runs without that peer")
endif()
