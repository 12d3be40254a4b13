#include "programs/ProgramFile.hpp"

#include "common/config/ConfigReader.hpp"
#include "controller/ControllerMachine.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/core/ParseNumber.hpp>
#include <acs/core/Result.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

namespace ACS::OpenStreamSim
{

namespace
{

using Core::ESegmentKind;

constexpr const char* FROM = "from";
constexpr const char* TO = "to";
constexpr const char* COVER = "cover";
constexpr const char* SET = "set";
constexpr const char* BUTTON = "button";
constexpr const char* ECHO = "echo";
constexpr std::string_view DEFAULT_ECHO = "ml105";

std::optional<int> ParseNumberOrNull(const std::string& text)
{
    const std::optional<int> number = Core::ParseNumberOrNull<int>(text);
    const bool bPlain = number.has_value() && text == fmt::to_string(*number);
    return bPlain && *number >= FIRST_PROGRAM && *number <= LAST_PROGRAM ? number : std::nullopt;
}

/// Whether the relay shares a byte with the words in which programs report their progress.
bool IsOutcome(const RelayName& relay)
{
    const std::size_t first = GetFirstByte(relay);
    const std::size_t end = first + GetBytes(relay.width);
    return relay.block == PROGRAM_BLOCK && first < ECHO_BYTE + GetBytes(ERelayWidth::Long) && end > STARTED_BYTE;
}

/// The kinds of places that a key accepts, and their text in errors.
struct PlaceKey
{
    const char* key;
    std::vector<ESegmentKind> kinds;
    std::string_view expected;
};

PlaceKey MakePortKey(const char* key)
{
    return {key, {ESegmentKind::CassettePort, ESegmentKind::TrayPort, ESegmentKind::MemoryPort}, "a CP, TP or MP"};
}

PlaceKey MakeSetKey()
{
    return {SET, {ESegmentKind::Set}, "a SET"};
}

PlaceKey MakeButtonKey()
{
    return {BUTTON, {ESegmentKind::Set, ESegmentKind::CassettePort}, "a SET or CP"};
}

/// One table: [11].
class ProgramReader
{
    Apps::ConfigSection _section;
    std::string _echoText; ///< As in the file; empty if absent.

public:
    ProgramReader(Apps::ConfigSection section, std::string echoText)
        : _section(std::move(section)),
          _echoText(std::move(echoText))
    {
    }

    [[nodiscard]] ProgramSpec Read() const
    {
        using namespace std::chrono_literals;
        constexpr std::chrono::milliseconds SHORTEST = 1ms;
        constexpr std::chrono::milliseconds LONGEST = 24h;
        ProgramSpec spec;
        spec.duration = _section.GetDuration("duration", SHORTEST, LONGEST, spec.duration);
        spec.bFails = _section.IsEnabled("fail", spec.bFails);
        spec.echo = ReadEchoOrNull();
        spec.work = ReadWork();
        return spec;
    }

private:
    [[nodiscard]] PlaceTemplates ReadPlaces(const PlaceKey& key) const
    {
        PlaceTemplates places;
        const bool bGiven = _section.HasKey(key.key);
        const std::vector<std::string> texts = _section.GetStringList(key.key);
        for (const std::string& text : texts)
        {
            Core::Result<PlaceTemplate> place = PlaceTemplate::Parse(text);
            if (!place.has_value())
            {
                const Core::Error& error = place.error();
                _section.AddError(key.key, fmt::format("expected {}, found {}", error.expected, error.found));
            }
            else if (std::ranges::find(key.kinds, place->GetKind()) == key.kinds.end())
            {
                const std::string found = Core::QuoteForError(text);
                _section.AddError(key.key, fmt::format("expected {}, found {}", key.expected, found));
            }
            else
            {
                places.push_back(std::move(*place));
            }
        }
        const auto last = std::ranges::find_if(places, [](const PlaceTemplate& place) { return !place.HasRelays(); });
        if (last != places.end() && std::next(last) != places.end())
        {
            _section.AddError(
                key.key,
                fmt::format(
                    "expected {} at the end: it always applies, so the places after it never do",
                    Core::QuoteForError(last->GetText())));
        }
        if (bGiven && texts.empty())
        {
            _section.AddError(key.key, "expected at least one place, found an empty list");
        }
        return places;
    }

    [[nodiscard]] std::optional<RelayName> ReadEchoOrNull() const
    {
        if (_section.HasKey(ECHO) && (_echoText == "-1" || _echoText == "false"))
        {
            return std::nullopt;
        }
        const std::string text = _section.GetString(ECHO, std::string(DEFAULT_ECHO));
        const std::optional<RelayName> relay = ParseRelayNameOrNull(text);
        if (!relay.has_value() || relay->width == ERelayWidth::Float)
        {
            _section.AddError(
                ECHO,
                fmt::format(
                    "expected a relay that holds a whole number, such as 'ml105', or -1 for none, found {}",
                    Core::QuoteForError(text)));
            return std::nullopt;
        }
        if (IsOutcome(*relay))
        {
            _section.AddError(
                ECHO,
                fmt::format(
                    "expected a relay that a client writes, such as 'ml105', found {}: the program itself writes ml100 to "
                    "ml104",
                    Core::QuoteForError(text)));
        }
        return relay;
    }

    [[nodiscard]] TransferWork ReadTransfer() const
    {
        TransferWork transfer{ReadPlaces(MakePortKey(FROM)), ReadPlaces(MakePortKey(TO))};
        for (const char* key : {FROM, TO})
        {
            if (!_section.HasKey(key))
            {
                _section.AddError(key, "missing: from and to belong together");
            }
        }
        std::set<ESegmentKind> kinds;
        for (const PlaceTemplates* places : {&transfer.from, &transfer.to})
        {
            for (const PlaceTemplate& place : *places)
            {
                kinds.insert(place.GetKind());
            }
        }
        if (kinds.size() > 1)
        {
            _section.AddError(TO, "expected places of one kind in from and to: CP, TP or MP");
        }
        return transfer;
    }

    [[nodiscard]] CoverWork ReadCover() const
    {
        CoverWork cover;
        cover.bClose = _section.GetWord(COVER, {"open", "close"}) == "close";
        cover.set = ReadPlaces(MakeSetKey());
        if (!_section.HasKey(SET))
        {
            _section.AddError(SET, "missing: cover and set belong together");
        }
        return cover;
    }

    [[nodiscard]] ProgramWork ReadWork() const
    {
        const bool bTransfer = _section.HasKey(FROM) || _section.HasKey(TO);
        const bool bCover = _section.HasKey(COVER) || _section.HasKey(SET);
        const bool bButton = _section.HasKey(BUTTON);
        if (static_cast<int>(bTransfer) + static_cast<int>(bCover) + static_cast<int>(bButton) > 1)
        {
            _section.Refuse("expected one kind of work: from and to, cover and set, or button");
            return {};
        }
        if (bTransfer)
        {
            return ReadTransfer();
        }
        if (bCover)
        {
            return ReadCover();
        }
        if (bButton)
        {
            return ButtonWork{ReadPlaces(MakeButtonKey())};
        }
        return {};
    }
};

ProgramFile ReadPrograms(const Apps::ConfigReader& reader)
{
    ProgramFile file;
    const Apps::ConfigSection root = reader.GetRoot();
    const std::map<std::string, std::string> values = reader.GetValues();
    for (const std::string& name : root.GetNames())
    {
        const std::optional<int> number = ParseNumberOrNull(name);
        const Apps::ConfigSection section = root.GetSection(name);
        if (!number.has_value())
        {
            section.Refuse(fmt::format("expected the number of a program from {} to {}", FIRST_PROGRAM, LAST_PROGRAM));
            continue;
        }
        const auto echo = values.find(fmt::format("{}.{}", name, ECHO));
        file.programs.emplace(
            *number,
            ProgramReader(section, echo == values.end() ? std::string() : echo->second).Read());
    }
    file.errors = reader.GetErrors();
    if (!file.errors.empty())
    {
        file.programs.clear();
    }
    return file;
}

bool HasRobotNameIn(const PlaceTemplates& templates)
{
    return std::ranges::any_of(templates, [](const PlaceTemplate& place) { return place.HasRobotName(); });
}

} // namespace

ProgramFile ProgramFile::Read(const std::string& fileName)
{
    return ReadPrograms(Apps::ConfigReader::ReadFile(fileName, {}));
}

ProgramFile ProgramFile::ReadText(std::string_view text, const std::string& fileName)
{
    return ReadPrograms(Apps::ConfigReader::ReadText(text, fileName, {}));
}

bool ProgramFile::HasRobotName() const
{
    return std::ranges::any_of(programs, [](const auto& entry) {
        return std::visit(
            Core::Overloaded{
                [](const std::monostate&) { return false; },
                [](const TransferWork& work) { return HasRobotNameIn(work.from) || HasRobotNameIn(work.to); },
                [](const CoverWork& work) { return HasRobotNameIn(work.set); },
                [](const ButtonWork& work) {
                    return HasRobotNameIn(work.place);
                }},
            entry.second.work);
    });
}

} // namespace ACS::OpenStreamSim
