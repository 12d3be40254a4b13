#include "site/TrajectoryFault.hpp"
#include <acs/core/ECoreError.hpp>
#include <acs/json/JsonDecoder.hpp>
#include <acs/json/JsonDocument.hpp>
#include <acs/plan/LifReader.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Planning
{

namespace
{

constexpr double HALF_TURN_DEGREES = 180.0;
constexpr double FULL_TURN_DEGREES = 360.0;
/// Files may round half a turn up (3.1416).
constexpr double MAXIMUM_THETA = 3.1416;
constexpr std::size_t MAXIMUM_NAME = 256;
constexpr std::size_t MAXIMUM_DEGREE = 3; // also the default; FindFault checks it
constexpr std::size_t MAXIMUM_ELEMENTS = 100'000;
constexpr std::size_t MAXIMUM_BYTES = 64U * 1024U * 1024U;

struct LifMeta
{
    std::string projectIdentification;
    std::string creator;
    std::string exportTimestamp;
    std::string lifVersion;
};

struct LifPosition
{
    double x = 0;
    double y = 0;
};

struct LifTrajectory
{
    std::optional<std::size_t> degree;
    std::vector<double> knots;
    std::vector<Core::CurvePoint> points;
};

struct LifNode
{
    std::string nodeID;
    std::string mapID;
    LifPosition position;
    std::vector<SiteNodeRule> rules;
};

struct LifLayout
{
    std::string layoutID;
    std::string layoutVersion;
    std::vector<LifNode> nodes;
    std::vector<SiteEdge> edges;
    std::vector<SiteStation> stations;
};

struct LifFile
{
    LifMeta meta;
    std::vector<LifLayout> layouts;
};

double ToRadians(double degrees)
{
    const double turned = degrees > HALF_TURN_DEGREES ? degrees - FULL_TURN_DEGREES : degrees;
    return turned * std::numbers::pi / HALF_TURN_DEGREES;
}

/// Path in the file of an element of the merged lists: "edges[3].x" of the second layout was "layouts[1].edges[1].x".
std::string LocatePath(const std::string& path, const std::vector<std::vector<std::size_t>>& counts)
{
    static constexpr std::array<std::string_view, 3> LISTS{"nodes", "edges", "stations"};
    const std::size_t open = path.find('[');
    const std::size_t close = path.find(']');
    if (open == std::string::npos || close == std::string::npos)
    {
        return "layouts";
    }
    const auto* const list = std::ranges::find(LISTS, std::string_view(path).substr(0, open));
    std::size_t index = std::stoul(path.substr(open + 1, close - open - 1));
    const auto listIndex = static_cast<std::size_t>(list - LISTS.begin());
    std::size_t layout = 0;
    while (layout + 1 < counts.size() && index >= counts[layout][listIndex])
    {
        index -= counts[layout][listIndex];
        ++layout;
    }
    return fmt::format("layouts[{}].{}[{}]{}", layout, *list, index, path.substr(close + 1));
}

} // namespace

} // namespace ACS::Planning

namespace ACS::Json
{

template <>
struct JsonFields<Planning::LifMeta>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("projectIdentification", &Planning::LifMeta::projectIdentification),
        Required("creator", &Planning::LifMeta::creator),
        Required("exportTimestamp", &Planning::LifMeta::exportTimestamp),
        Required("lifVersion", &Planning::LifMeta::lifVersion));
};

template <>
struct JsonFields<Planning::LifPosition>
{
    static constexpr auto FIELDS =
        std::make_tuple(Required("x", &Planning::LifPosition::x), Required("y", &Planning::LifPosition::y));
};

template <>
struct EnumNames<Planning::EActionRequirement>
{
    using Type = Planning::EActionRequirement;
    static constexpr std::array WORDS{
        EnumWord<Type>{Type::Optional, "OPTIONAL"},
        EnumWord<Type>{Type::Conditional, "CONDITIONAL"},
        EnumWord<Type>{Type::Required, "REQUIRED"}};
};

template <>
struct EnumNames<Planning::EActionBlocking>
{
    using Type = Planning::EActionBlocking;
    static constexpr std::array WORDS{
        EnumWord<Type>{Type::None, "NONE"},
        EnumWord<Type>{Type::Soft, "SOFT"},
        EnumWord<Type>{Type::Hard, "HARD"}};
};

template <>
struct JsonFields<Planning::SiteActionParameter>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("key", &Planning::SiteActionParameter::key).WithLength(1, Planning::MAXIMUM_NAME),
        Required("value", &Planning::SiteActionParameter::value));
};

template <>
struct JsonFields<Planning::SiteAction>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("actionType", &Planning::SiteAction::actionType).WithLength(1, Planning::MAXIMUM_NAME),
        Optional("actionDescription", &Planning::SiteAction::description),
        Defaulted("requirementType", &Planning::SiteAction::requirement),
        Required("blockingType", &Planning::SiteAction::blocking),
        Optional("actionParameters", &Planning::SiteAction::parameters));
};

template <>
struct JsonFields<Core::CurvePoint>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("x", &Core::CurvePoint::x),
        Required("y", &Core::CurvePoint::y),
        Optional("weight", &Core::CurvePoint::weight));
};

template <>
struct JsonFields<Planning::LifTrajectory>
{
    static constexpr auto FIELDS = std::make_tuple(
        Optional("degree", &Planning::LifTrajectory::degree),
        Required("knotVector", &Planning::LifTrajectory::knots),
        Required("controlPoints", &Planning::LifTrajectory::points));
};

template <>
struct ValueDecoder<Core::Nurbs>
{
    [[nodiscard]] static bool TryDecode(
        const Value& value,
        Core::Nurbs& out,
        const FieldBounds& bounds,
        DecodeContext& context)
    {
        Planning::LifTrajectory trajectory;
        if (!ValueDecoder<Planning::LifTrajectory>::TryDecode(value, trajectory, bounds, context))
        {
            return false;
        }
        Planning::ScaleKnots(trajectory.knots);
        out = {
            trajectory.degree.value_or(Planning::MAXIMUM_DEGREE),
            std::move(trajectory.knots),
            std::move(trajectory.points)};
        return true;
    }
};

template <>
struct JsonFields<Planning::SiteNodeRule>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("vehicleTypeId", &Planning::SiteNodeRule::vehicleTypeID).WithLength(1, Planning::MAXIMUM_NAME),
        Optional("theta", &Planning::SiteNodeRule::theta).Between(-Planning::MAXIMUM_THETA, Planning::MAXIMUM_THETA),
        Optional("actions", &Planning::SiteNodeRule::actions));
};

template <>
struct JsonFields<Planning::LifNode>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("nodeId", &Planning::LifNode::nodeID).WithLength(1, Planning::MAXIMUM_NAME),
        Optional("mapId", &Planning::LifNode::mapID),
        Required("nodePosition", &Planning::LifNode::position),
        Required("vehicleTypeNodeProperties", &Planning::LifNode::rules));
};

template <>
struct JsonFields<Planning::SiteLoadRestriction>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("unloaded", &Planning::SiteLoadRestriction::bUnloaded),
        Required("loaded", &Planning::SiteLoadRestriction::bLoaded));
};

template <>
struct JsonFields<Planning::SiteEdgeRule>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("vehicleTypeId", &Planning::SiteEdgeRule::vehicleTypeID).WithLength(1, Planning::MAXIMUM_NAME),
        Optional("vehicleOrientation", &Planning::SiteEdgeRule::orientation).Between(0, Planning::FULL_TURN_DEGREES),
        Optional("orientationType", &Planning::SiteEdgeRule::orientationType),
        Optional("rotationAllowed", &Planning::SiteEdgeRule::bRotationAllowed),
        Optional("maxSpeed", &Planning::SiteEdgeRule::maxSpeed),
        Optional("maxRotationSpeed", &Planning::SiteEdgeRule::maxRotationSpeed),
        Optional("loadRestriction", &Planning::SiteEdgeRule::loadRestriction),
        Optional("minHeight", &Planning::SiteEdgeRule::minHeight),
        Optional("maxHeight", &Planning::SiteEdgeRule::maxHeight),
        Optional("trajectory", &Planning::SiteEdgeRule::trajectory),
        Optional("actions", &Planning::SiteEdgeRule::actions));
};

template <>
struct JsonFields<Planning::SiteEdge>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("edgeId", &Planning::SiteEdge::edgeID).WithLength(1, Planning::MAXIMUM_NAME),
        Required("startNodeId", &Planning::SiteEdge::startNodeID),
        Required("endNodeId", &Planning::SiteEdge::endNodeID),
        Required("vehicleTypeEdgeProperties", &Planning::SiteEdge::rules));
};

template <>
struct JsonFields<Planning::SiteStation>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("stationId", &Planning::SiteStation::stationID).WithLength(1, Planning::MAXIMUM_NAME),
        Required("interactionNodeIds", &Planning::SiteStation::nodeIDs),
        Optional("stationHeight", &Planning::SiteStation::height));
};

template <>
struct JsonFields<Planning::LifLayout>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("layoutId", &Planning::LifLayout::layoutID),
        Required("layoutVersion", &Planning::LifLayout::layoutVersion),
        Required("nodes", &Planning::LifLayout::nodes),
        Required("edges", &Planning::LifLayout::edges),
        Required("stations", &Planning::LifLayout::stations));
};

template <>
struct JsonFields<Planning::LifFile>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("metaInformation", &Planning::LifFile::meta),
        Required("layouts", &Planning::LifFile::layouts));
};

} // namespace ACS::Json

namespace ACS::Planning
{

namespace
{

Core::Result<LifFile> DecodeFile(std::string_view text)
{
    Json::JsonDocument document;
    Json::ParseLimits limits;
    limits.bytes = MAXIMUM_BYTES;
    limits.values = MAXIMUM_BYTES; // a file of the operator: its length is enough
    const Core::Result<const Json::Value*> root = document.Parse(text, limits);
    if (!root.has_value())
    {
        return tl::unexpected(root.error());
    }
    Json::DecodeOptions options;
    options.maximumArray = MAXIMUM_ELEMENTS;
    Json::DecodeContext context(options);
    LifFile file;
    if (!Json::TryDecode(**root, file, {}, context))
    {
        return tl::unexpected(context.TakeError());
    }
    if (!file.meta.lifVersion.starts_with("1."))
    {
        return Core::Fail(
            Core::ECoreError::UnknownWord,
            "metaInformation.lifVersion",
            "LIF version 1, such as 1.0.0",
            file.meta.lifVersion);
    }
    return file;
}

/// Empty: the edge has no trajectory for the vehicle type, or a valid one.
std::string FindFault(const SiteMap& site, const SiteEdge& edge, const SiteEdgeRule& rule)
{
    if (!rule.trajectory.has_value())
    {
        return {};
    }
    const std::size_t degree = rule.trajectory->degree;
    return degree < 1 || degree > MAXIMUM_DEGREE
        ? fmt::format("the degree must be from 1 to {}, found {}", MAXIMUM_DEGREE, degree)
        : FindTrajectoryFault(*rule.trajectory, edge, site);
}

/// An edge without a rule for a vehicle type is closed for it. The site has the nodes of the edges.
void CloseEdges(const SiteMap& site, std::vector<SiteEdge>& edges, std::vector<std::string>& warnings)
{
    for (SiteEdge& edge : edges)
    {
        std::vector<std::string> closed;
        for (const SiteEdgeRule& rule : edge.rules)
        {
            const std::string fault = FindFault(site, edge, rule);
            if (!fault.empty())
            {
                closed.push_back(rule.vehicleTypeID);
                warnings.push_back(fmt::format(
                    "{} does not use the edge {}, because its trajectory is invalid: {}",
                    rule.vehicleTypeID,
                    edge.edgeID,
                    fault));
            }
        }
        std::erase_if(edge.rules, [&closed](const SiteEdgeRule& rule) {
            return std::ranges::find(closed, rule.vehicleTypeID) != closed.end();
        });
    }
}

std::vector<SiteEdge> WithoutTrajectories(std::vector<SiteEdge> edges)
{
    for (SiteEdge& edge : edges)
    {
        for (SiteEdgeRule& rule : edge.rules)
        {
            rule.trajectory.reset();
        }
    }
    return edges;
}

/// LIF does not require a mapId, and VDA5050 requires it of every position.
void ReportNodesWithoutMap(const LifFile& file, std::vector<std::string>& warnings)
{
    std::size_t count = 0;
    std::string first;
    for (std::size_t layout = 0; layout < file.layouts.size(); ++layout)
    {
        const std::vector<LifNode>& nodes = file.layouts[layout].nodes;
        for (std::size_t node = 0; node < nodes.size(); ++node)
        {
            if (nodes[node].mapID.empty())
            {
                first = count == 0 ? fmt::format("layouts[{}].nodes[{}]", layout, node) : first;
                ++count;
            }
        }
    }
    if (count > 0)
    {
        warnings.push_back(fmt::format(
            "{} {}: a vehicle rejects an order whose nodes do not name its map",
            count == 1 ? "1 node has no mapId," : fmt::format("{} nodes have no mapId, the first is", count),
            first));
    }
}

Core::Result<SiteMap> MakeSite(LifFile&& file, std::vector<std::string>& warnings)
{
    ReportNodesWithoutMap(file, warnings);
    std::vector<SiteNode> nodes;
    std::vector<SiteEdge> edges;
    std::vector<SiteStation> stations;
    std::vector<std::vector<std::size_t>> counts;
    for (LifLayout& layout : file.layouts)
    {
        counts.push_back({layout.nodes.size(), layout.edges.size(), layout.stations.size()});
        for (LifNode& node : layout.nodes)
        {
            nodes.push_back(
                {std::move(node.nodeID),
                 node.position.x,
                 node.position.y,
                 std::move(node.mapID),
                 std::move(node.rules)});
        }
        for (SiteEdge& edge : layout.edges)
        {
            for (SiteEdgeRule& rule : edge.rules)
            {
                rule.orientation =
                    rule.orientation.has_value() ? std::optional(ToRadians(*rule.orientation)) : std::nullopt;
            }
            edges.push_back(std::move(edge));
        }
        std::ranges::move(layout.stations, std::back_inserter(stations));
    }
    // Trajectories are checked against nodes that are known to be valid, and never refuse the map.
    Core::Result<SiteMap> site = SiteMap::Create(std::move(nodes), WithoutTrajectories(edges), std::move(stations));
    if (!site.has_value())
    {
        site.error().path = LocatePath(site.error().path, counts);
        return site;
    }
    CloseEdges(*site, edges, warnings);
    return SiteMap::Create(site->GetNodes(), std::move(edges), site->GetStations());
}

} // namespace

Core::Result<SiteMap> DecodeLIF(std::string_view text, std::vector<std::string>& warnings)
{
    Core::Result<LifFile> file = DecodeFile(text);
    return file.has_value() ? MakeSite(std::move(*file), warnings) : tl::unexpected(std::move(file.error()));
}

Core::Result<SiteMap> DecodeLIF(std::string_view text)
{
    std::vector<std::string> ignored;
    return DecodeLIF(text, ignored);
}

} // namespace ACS::Planning
