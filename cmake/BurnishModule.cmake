# What every target of this project is compiled with. -ffp-contract=off: a fused multiply-add would
# round once where another machine rounds twice, and results must be the same bytes everywhere.
# Eigen's vectorised reductions sum in an order that depends on alignment, so they are off.
add_library(burnish_flags INTERFACE)
target_compile_options(burnish_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # g++ 12 warns of overlapping copies inside std::string's operator+ where there are none (PR 105651).
  target_compile_options(burnish_flags INTERFACE -Wno-restrict)
endif()
target_compile_definitions(burnish_flags INTERFACE EIGEN_DONT_VECTORIZE)
if(BURNISH_SANITIZE)
  target_compile_options(burnish_flags INTERFACE -fsanitize=${BURNISH_SANITIZE}
                         -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(burnish_flags INTERFACE -fsanitize=${BURNISH_SANITIZE})
endif()
if(BURNISH_BUILD_FUZZERS)
  target_compile_options(burnish_flags INTERFACE -fsanitize=fuzzer-no-link)
  target_compile_definitions(burnish_flags INTERFACE FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION)
endif()

# burnish_module(NAME USES module... PUBLIC library... PRIVATE library...)
# One folder of src/burnish is one target, which links the modules that it may include, no others.
function(burnish_module name)
  cmake_parse_arguments(ARG "" "" "USES;PUBLIC;PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS *.cpp)
  add_library(burnish_${name} STATIC ${sources})
  add_library(burnish::${name} ALIAS burnish_${name})
  set_target_properties(burnish_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_compile_features(burnish_${name} PUBLIC cxx_std_20)
  target_include_directories(burnish_${name} PUBLIC
      $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  list(TRANSFORM ARG_USES PREPEND burnish::)
  target_link_libraries(burnish_${name} PUBLIC ${ARG_USES} ${ARG_PUBLIC}
                        PRIVATE ${ARG_PRIVATE} $<BUILD_INTERFACE:burnish_flags>)
  if(BURNISH_PRECOMPILE)
    target_precompile_headers(burnish_${name} PRIVATE <algorithm> <array> <cmath> <functional> <memory>
                              <optional> <span> <string> <string_view> <variant> <vector>)
  endif()
  set_property(GLOBAL APPEND PROPERTY BURNISH_MODULES ${name})
endfunction()
