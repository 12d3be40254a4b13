#include <acs/core/ControlCharacter.hpp>
#include <acs/core/Result.hpp>
#include <acs/json/JsonDocument.hpp>
#include <acs/plan/UnusedLifMember.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace ACS::Planning
{

namespace
{

using Json::Value;

enum class ERole : std::uint8_t
{
    Objects, ///< An object or a list of objects whose members are checked.
    Used,
    Informative,
    Demand,
    Actions, ///< A list; the elements that are not REQUIRED are unused.
};

bool IsDemand(const Value& /*value*/)
{
    return true;
}

bool IsFalse(const Value& value)
{
    return value.IsFalse();
}

bool HasRequirement(const Value& action, std::string_view requirement)
{
    const Value* const typeOrNull = Json::FindFirstOrNull(action, "requirementType");
    return typeOrNull != nullptr && typeOrNull->IsString() && typeOrNull->GetString() == requirement;
}

bool IsConditional(const Value& action)
{
    return HasRequirement(action, "CONDITIONAL");
}

bool IsTurnRestricted(const Value& value)
{
    return !value.IsString() || value.GetString() != std::string_view("BOTH");
}

bool IsFilled(const Value& list)
{
    return !list.IsArray() || !list.Empty();
}

struct KnownMember
{
    std::string_view owner; ///< Path of the objects that have it.
    std::string_view name;
    ERole role = ERole::Used;
    std::string_view effect = {};                 ///< Of Demand and Actions.
    bool (*isDemanded)(const Value&) = &IsDemand; ///< Likewise.
};

constexpr std::string_view META = "metaInformation";
constexpr std::string_view LAYOUT = "layouts[]";
constexpr std::string_view NODE = "layouts[].nodes[]";
constexpr std::string_view NODE_POSITION = "layouts[].nodes[].nodePosition";
constexpr std::string_view NODE_RULE = "layouts[].nodes[].vehicleTypeNodeProperties[]";
constexpr std::string_view EDGE = "layouts[].edges[]";
constexpr std::string_view EDGE_RULE = "layouts[].edges[].vehicleTypeEdgeProperties[]";
constexpr std::string_view LOAD_RULE = "layouts[].edges[].vehicleTypeEdgeProperties[].loadRestriction";
constexpr std::string_view STATION = "layouts[].stations[]";
constexpr std::string_view NO_ACTIONS = "CONDITIONAL actions are not sent to vehicles";
constexpr std::string_view NO_TURN_LIMIT = "the turn on the node is not restricted";

/// The members of LIF 1.0, and the corridor of VDA5050, which a file may have too. LifReader.cpp decodes the used ones.
constexpr std::array KNOWN{
    KnownMember{"", "metaInformation", ERole::Objects},
    KnownMember{META, "projectIdentification", ERole::Informative},
    KnownMember{META, "creator", ERole::Informative},
    KnownMember{META, "exportTimestamp", ERole::Informative},
    KnownMember{META, "lifVersion"},
    KnownMember{"", "layouts", ERole::Objects},
    KnownMember{LAYOUT, "layoutId", ERole::Informative},
    KnownMember{LAYOUT, "layoutName", ERole::Informative},
    KnownMember{LAYOUT, "layoutVersion", ERole::Informative},
    KnownMember{LAYOUT, "layoutLevelId", ERole::Informative},
    KnownMember{LAYOUT, "layoutDescription", ERole::Informative},
    KnownMember{LAYOUT, "nodes", ERole::Objects},
    KnownMember{NODE, "nodeId"},
    KnownMember{NODE, "nodeName", ERole::Informative},
    KnownMember{NODE, "nodeDescription", ERole::Informative},
    KnownMember{NODE, "mapId"},
    KnownMember{NODE, "nodePosition", ERole::Objects},
    KnownMember{NODE_POSITION, "x"},
    KnownMember{NODE_POSITION, "y"},
    KnownMember{NODE, "vehicleTypeNodeProperties", ERole::Objects},
    KnownMember{NODE_RULE, "vehicleTypeId"},
    KnownMember{NODE_RULE, "theta"},
    KnownMember{NODE_RULE, "actions", ERole::Actions, NO_ACTIONS, &IsConditional},
    KnownMember{LAYOUT, "edges", ERole::Objects},
    KnownMember{EDGE, "edgeId"},
    KnownMember{EDGE, "edgeName", ERole::Informative},
    KnownMember{EDGE, "edgeDescription", ERole::Informative},
    KnownMember{EDGE, "startNodeId"},
    KnownMember{EDGE, "endNodeId"},
    KnownMember{EDGE, "vehicleTypeEdgeProperties", ERole::Objects},
    KnownMember{EDGE_RULE, "vehicleTypeId"},
    KnownMember{EDGE_RULE, "vehicleOrientation"},
    KnownMember{EDGE_RULE, "orientationType"},
    KnownMember{EDGE_RULE, "rotationAllowed"},
    KnownMember{EDGE_RULE, "rotationAtStartNodeAllowed", ERole::Demand, NO_TURN_LIMIT, &IsTurnRestricted},
    KnownMember{EDGE_RULE, "rotationAtEndNodeAllowed", ERole::Demand, NO_TURN_LIMIT, &IsTurnRestricted},
    KnownMember{EDGE_RULE, "maxSpeed"},
    KnownMember{EDGE_RULE, "maxRotationSpeed"},
    KnownMember{EDGE_RULE, "minHeight"},
    KnownMember{EDGE_RULE, "maxHeight"},
    KnownMember{EDGE_RULE, "loadRestriction", ERole::Objects},
    KnownMember{LOAD_RULE, "unloaded"},
    KnownMember{LOAD_RULE, "loaded"},
    KnownMember{LOAD_RULE, "loadSetNames", ERole::Demand, "vehicles use the edge with any load", &IsFilled},
    KnownMember{EDGE_RULE, "trajectory"},
    KnownMember{EDGE_RULE, "corridor", ERole::Demand, "it is given in the configuration, site.corridors"},
    KnownMember{EDGE_RULE, "actions", ERole::Actions, NO_ACTIONS, &IsConditional},
    KnownMember{
        EDGE_RULE,
        "reentryAllowed",
        ERole::Demand,
        "a vehicle that becomes automatic on the edge is used at once",
        &IsFalse},
    KnownMember{LAYOUT, "stations", ERole::Objects},
    KnownMember{STATION, "stationId"},
    KnownMember{STATION, "interactionNodeIds"},
    KnownMember{STATION, "stationName", ERole::Informative},
    KnownMember{STATION, "stationDescription", ERole::Informative},
    KnownMember{STATION, "stationHeight"},
    KnownMember{STATION, "stationPosition", ERole::Informative},
};

const KnownMember* FindKnownOrNull(std::string_view owner, std::string_view name)
{
    const auto* const known = std::ranges::find_if(KNOWN, [owner, name](const KnownMember& member) {
        return member.name == name && member.owner == owner;
    });
    return known == KNOWN.end() ? nullptr : known;
}

std::string Join(const std::string& owner, std::string_view name)
{
    return owner.empty() ? std::string(name) : fmt::format("{}.{}", owner, name);
}

class MemberCounter
{
    using EKind = UnusedLifMember::EKind;

    std::map<std::pair<EKind, std::string>, UnusedLifMember> _found;

public:
    /// owner: path without indices; place: with them.
    void VisitRecursive( // NOLINT(misc-no-recursion): as deep as the table
        const Value& object,
        const std::string& owner,
        const std::string& place)
    {
        if (!object.IsObject())
        {
            return;
        }
        for (const auto& member : object.GetObject())
        {
            const std::string_view name(member.name.GetString(), member.name.GetStringLength());
            if (member.value.IsNull())
            {
                continue;
            }
            const KnownMember* const knownOrNull = FindKnownOrNull(owner, name);
            if (knownOrNull == nullptr)
            {
                const std::string shown =
                    Core::HasControlCharacter(name) ? Core::QuoteForError(name) : std::string(name);
                Count(EKind::Unknown, Join(owner, shown), Join(place, shown), {});
            }
            else if (knownOrNull->role != ERole::Used)
            {
                VisitKnownRecursive(member.value, *knownOrNull, Join(owner, name), Join(place, name));
            }
        }
    }

    [[nodiscard]] std::vector<UnusedLifMember> TakeAll()
    {
        std::vector<UnusedLifMember> all;
        for (auto& [key, member] : std::exchange(_found, {}))
        {
            all.push_back(std::move(member));
        }
        return all;
    }

private:
    void VisitKnownRecursive( // NOLINT(misc-no-recursion): as deep as the table
        const Value& value,
        const KnownMember& known,
        const std::string& path,
        const std::string& place)
    {
        const bool bByElement = known.role == ERole::Objects || known.role == ERole::Actions;
        if (!bByElement || !value.IsArray())
        {
            VisitElementRecursive(value, known, path, place);
            return;
        }
        for (rapidjson::SizeType i = 0; i < value.Size(); ++i)
        {
            VisitElementRecursive(value[i], known, path + "[]", fmt::format("{}[{}]", place, i));
        }
    }

    void VisitElementRecursive( // NOLINT(misc-no-recursion): as deep as the table
        const Value& value,
        const KnownMember& known,
        const std::string& path,
        const std::string& place)
    {
        if (known.role == ERole::Objects)
        {
            VisitRecursive(value, path, place);
            return;
        }
        if (known.role == ERole::Actions && HasRequirement(value, "REQUIRED"))
        {
            return;
        }
        const bool bDemand = known.role != ERole::Informative && known.isDemanded(value);
        Count(
            bDemand ? EKind::Unsupported : EKind::Informative,
            path,
            place,
            bDemand ? known.effect : std::string_view());
    }

    void Count(EKind kind, const std::string& path, const std::string& place, std::string_view effect)
    {
        UnusedLifMember& member = _found[{kind, path}];
        if (member.count == 0)
        {
            member = {kind, path, std::string(effect), place, 0};
        }
        ++member.count;
    }
};

} // namespace

std::vector<UnusedLifMember> FindUnusedMembers(std::string_view text)
{
    Json::JsonDocument document;
    Json::ParseLimits limits;
    limits.bytes = text.size(); // DecodeLIF has the limit
    limits.values = text.size();
    const Core::Result<const Value*> root = document.Parse(text, limits);
    MemberCounter counter;
    if (root.has_value())
    {
        counter.VisitRecursive(**root, {}, {});
    }
    return counter.TakeAll();
}

} // namespace ACS::Planning
