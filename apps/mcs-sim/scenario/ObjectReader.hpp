#pragma once

#include <acs/core/Result.hpp>
#include <acs/json/JsonDocument.hpp>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::McsSim
{

/// Reads the members of a JSON object of a file one after the other, each at most once. The first error is kept; values read
/// after it are meaningless. A member that was not read is an error as well (Finish): it is misspelt.
class ObjectReader
{
    const Json::Value& _object;
    std::string _path;
    std::vector<std::string_view> _taken;
    std::optional<Core::Error> _error;

public:
    /// The value outlives the reader; one that is not an object is an error. The path leads to it, empty for the whole file.
    ObjectReader(const Json::Value& object, std::string path);

    [[nodiscard]] bool HasMember(std::string_view name) const;
    /// Null where it is absent.
    [[nodiscard]] const Json::Value* TakeOrNull(std::string_view name);
    [[nodiscard]] std::string TakeText(std::string_view name);
    [[nodiscard]] std::string TakeText(std::string_view name, std::string_view otherwise);
    /// Takes true or false.
    [[nodiscard]] bool IsTrue(std::string_view name, bool bOtherwise);
    [[nodiscard]] std::uint32_t TakeNumber(
        std::string_view name,
        std::uint32_t otherwise,
        std::uint32_t smallest,
        std::uint32_t greatest);
    /// "200ms", "5s", "2m", "1h"
    [[nodiscard]] std::chrono::milliseconds TakeDuration(std::string_view name);
    [[nodiscard]] std::chrono::milliseconds TakeDuration(std::string_view name, std::chrono::milliseconds otherwise);

    /// The place of a member: "steps[2].within".
    [[nodiscard]] std::string GetPath(std::string_view name) const;
    void Refuse(std::string_view name, std::string expected, std::string found);
    /// An error from within a member.
    void Refuse(Core::Error error);
    [[nodiscard]] bool HasFailed() const noexcept;
    /// The first error, or success.
    [[nodiscard]] Core::Result<void> Finish();

private:
    [[nodiscard]] const Json::Value* TakeRequiredOrNull(std::string_view name, std::string_view expected);
};

} // namespace ACS::McsSim
