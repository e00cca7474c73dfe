find_package(rapidcheck REQUIRED)
list(APPEND libraries atrium_geometry atrium_synth TBB::tbb nlohmann_json::nlohmann_json rapidcheck)
