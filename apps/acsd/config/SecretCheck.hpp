#pragma once

#include "common/config/ConfigSection.hpp"
#include "common/config/Url.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// Rejects a file with a key or password that every user of the machine can read. An error of the key.
void CheckSecretFile(const Apps::ConfigSection& section, const std::string& key, const std::string& path);

/// Warns if every user of the machine can read the configuration, and so what the key has.
void WarnOfReadableConfig(const std::string& key, const std::string& fileName, std::vector<std::string>& warnings);

/// Warns if what the key has is sent unencrypted over a network.
void WarnOfPlainSecret(
    const std::string& key,
    const Apps::Url& url,
    std::string_view encryptedScheme,
    std::vector<std::string>& warnings);

} // namespace ACS::Acsd
