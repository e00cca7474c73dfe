list(APPEND libraries TBB::tbb nlohmann_json::nlohmann_json)
