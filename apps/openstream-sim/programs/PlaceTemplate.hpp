#pragma once

#include "programs/RelayMemory.hpp"
#include "programs/RelayName.hpp"
#include <acs/core/Location.hpp>
#include <acs/core/Result.hpp>

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace ACS::OpenStreamSim
{

/// A place of MCS-ACS whose numbers are in relays: "A{ml106}.CP{ml107}.TP{ml108}", "{robot}.TP{ml109}".
class PlaceTemplate
{
    /// {robot}
    struct RobotTag
    {
        bool operator==(const RobotTag&) const = default;
    };

    /// {ml106}
    struct WordTag
    {
        std::string text;
        RelayName relay;

        bool operator==(const WordTag&) const = default;
    };

    using Part = std::variant<std::string, RobotTag, WordTag>;

    std::string _text;
    std::vector<Part> _parts;

public:
    /// Fails with InvalidLocation if no numbers give a place, and with UnknownWord for a tag that is not a whole-number relay.
    [[nodiscard]] static Core::Result<PlaceTemplate> Parse(std::string_view text);

    /// The place with the current numbers of the relays, each with at least two digits. Fails with OutOfRange if one of them
    /// is below 1 or above 9999: the template does not apply then.
    [[nodiscard]] Core::Result<std::string> Fill(const RelayMemory& relays, std::string_view robotID) const;

    [[nodiscard]] const std::string& GetText() const noexcept;
    [[nodiscard]] Core::ESegmentKind GetKind() const;
    [[nodiscard]] bool HasRobotName() const;
    /// Without relays the place is constant, and the template always applies.
    [[nodiscard]] bool HasRelays() const;

    bool operator==(const PlaceTemplate&) const = default;

private:
    [[nodiscard]] static Core::Result<Part> ParseTag(std::string_view tag);
    [[nodiscard]] std::string MakeSample() const;
};

} // namespace ACS::OpenStreamSim
