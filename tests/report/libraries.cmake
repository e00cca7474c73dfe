list(APPEND libraries atrium_report nlohmann_json::nlohmann_json)
