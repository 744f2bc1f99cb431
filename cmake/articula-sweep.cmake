# SPDX-License-Identifier: Apache-2.0
# The component sweep: the target articula::sweep, for the headers that run many closed loops. The
# build of articula includes this file, and find_package(articula) includes the installed one. The
# target exists only if oneTBB and Boost's Sobol sequence are found. The targets
# articula::sweep_hdf5, articula::sweep_mpi and articula::sweep_search add HDF5, MPI and NLopt,
# each if it is found.

find_package(TBB 2021 CONFIG QUIET)
find_path(ARTICULA_SOBOL_INCLUDE_DIR boost/random/sobol.hpp HINTS ${Boost_INCLUDE_DIRS})
mark_as_advanced(ARTICULA_SOBOL_INCLUDE_DIR)

if(TARGET TBB::tbb AND ARTICULA_SOBOL_INCLUDE_DIR)
  if(NOT TARGET articula::sweep)
    add_library(articula::sweep INTERFACE IMPORTED GLOBAL)
    target_link_libraries(articula::sweep INTERFACE articula::articula TBB::tbb)
    target_include_directories(articula::sweep SYSTEM INTERFACE ${ARTICULA_SOBOL_INCLUDE_DIR})
  endif()

  # Libraries of C: found without enabling the language C.
  find_package(PkgConfig QUIET)
  function(articula_add_sweep_part name package)
    if(NOT PkgConfig_FOUND OR TARGET articula::sweep_${name})
      return()
    endif()
    pkg_check_modules(articula_${name} QUIET IMPORTED_TARGET GLOBAL ${package})
    if(TARGET PkgConfig::articula_${name})
      add_library(articula::sweep_${name} INTERFACE IMPORTED GLOBAL)
      target_link_libraries(articula::sweep_${name} INTERFACE articula::sweep
                                                              PkgConfig::articula_${name})
    endif()
  endfunction()
  articula_add_sweep_part(hdf5 hdf5)
  articula_add_sweep_part(mpi ompi-c)
  if(TARGET articula::sweep_mpi) # without the C++ interface, which MPI 3 has dropped
    target_compile_definitions(articula::sweep_mpi INTERFACE OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)
  endif()
  articula_add_sweep_part(search nlopt)
else()
  set(articula_sweep_FOUND FALSE)
  set(articula_NOT_FOUND_MESSAGE
      "articula's component sweep needs oneTBB (Debian: libtbb-dev) and Boost 1.71 (libboost-dev)")
endif()
