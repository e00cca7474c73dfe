find_package(rapidcheck REQUIRED)
list(APPEND libraries atrium_geometry atrium_synth TBB::tbb nlohmann_json::nlohmann_json rapidcheck)
list(APPEND alone structure_properties_test.cpp validity_test.cpp)
