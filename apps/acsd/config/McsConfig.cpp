#include "config/McsConfig.hpp"

#include "common/config/TextFile.hpp"
#include "config/SecretCheck.hpp"
#include <acs/core/Result.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

namespace ACS::Acsd
{

namespace
{

using namespace std::chrono_literals;
using Apps::ConfigSection;
using Apps::EUrlScheme;

constexpr std::int64_t MOST_RETRIES = 100;
constexpr std::int64_t LARGEST_WINDOW = 1'000;
constexpr std::int64_t SMALLEST_TEXT = 1'024;
constexpr std::int64_t LARGEST_TEXT = 1024LL * 1024 * 1024;
constexpr std::size_t LARGEST_HEADERS_FILE = 64U * 1024U;
constexpr std::string_view CREDENTIALS = "${CREDENTIALS_DIRECTORY}";

/// Certificates are read when the client is created. They are checked here too, to report their errors with those of the
/// configuration.
void ReadTLS(const ConfigSection& mcs, const std::string& fileName, McsConfig& config)
{
    if (!mcs.HasKey("tls"))
    {
        return;
    }
    const ConfigSection section = mcs.GetSection("tls");
    const auto readFile = [&](const std::string& key) {
        const std::string path = section.GetString(key, "");
        return path.empty() ? path : ResolvePath(fileName, path);
    };
    config.tls.caFile = readFile("ca");
    config.tls.certificateFile = readFile("certificate");
    config.tls.keyFile = readFile("key");
    config.tls.serverName = section.GetString("server_name", "");
    if (config.url.scheme == EUrlScheme::Ws)
    {
        mcs.AddError("tls", "is for wss:// only, and mcs.url is ws://, which encrypts nothing");
    }
    if (config.url.scheme != EUrlScheme::Wss)
    {
        return;
    }
    const Core::Result<void> checked = ProtocolBeast::CheckClientTLS(config.tls, config.url.peer.host);
    if (!checked.has_value())
    {
        Core::Error error = checked.error();
        const std::string key = error.path.substr(error.path.find('.') + 1);
        error.path.clear();
        section.AddError(key, Core::Describe(error));
    }
    else if (!config.tls.keyFile.empty())
    {
        CheckSecretFile(section, "key", config.tls.keyFile);
    }
}

void ReadHostHeader(const ConfigSection& mcs, McsConfig& config)
{
    config.host = mcs.GetString("host", "");
    const Core::Result<void> host = ProtocolBeast::CheckHostHeader(config.host);
    if (!host.has_value())
    {
        mcs.AddError("host", "expected " + host.error().expected);
    }
    else if (!config.host.empty() && !Apps::ParseEndpoint(config.host) && !Apps::ParseEndpoint(config.host + ":80"))
    {
        mcs.AddError("host", fmt::format("expected HOST or HOST:PORT, found {}", Core::QuoteForError(config.host)));
    }
}

void ReadHeaders(const ConfigSection& mcs, McsConfig& config)
{
    if (!mcs.HasKey("headers"))
    {
        return;
    }
    const ConfigSection section = mcs.GetSection("headers");
    for (const std::string& name : section.GetNames())
    {
        const ProtocolBeast::HttpHeaders header{{name, section.GetString(name)}};
        const Core::Result<void> checked = ProtocolBeast::CheckHttpHeaders(header);
        if (checked.has_value())
        {
            config.headers.push_back(header[0]);
        }
        else
        {
            section.AddError(name, "expected " + checked.error().expected);
        }
    }
}

std::string_view Trim(std::string_view text)
{
    constexpr std::string_view SPACE = " \t\r";
    const std::size_t begin = text.find_first_not_of(SPACE);
    return begin == std::string_view::npos ? std::string_view()
                                           : text.substr(begin, text.find_last_not_of(SPACE) + 1 - begin);
}

/// Why the line of a file with headers is invalid, without its value; empty if it is valid or has none.
std::string AddHeader(std::string_view line, ProtocolBeast::HttpHeaders& headers)
{
    line = Trim(line);
    if (line.empty() || line.front() == '#')
    {
        return {};
    }
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos)
    {
        return "expected NAME: VALUE";
    }
    ProtocolBeast::HttpHeaders header{
        {std::string(Trim(line.substr(0, colon))), std::string(Trim(line.substr(colon + 1)))}};
    const Core::Result<void> checked = ProtocolBeast::CheckHttpHeaders(header);
    if (!checked.has_value())
    {
        return "expected " + checked.error().expected;
    }
    headers.push_back(std::move(header[0]));
    return {};
}

void ReadHeadersFile(const ConfigSection& mcs, const std::string& fileName, McsConfig& config)
{
    const std::string key = "headers_file";
    const std::string file = mcs.GetString(key, "");
    if (file.empty())
    {
        return;
    }
    const std::string path = ResolvePath(fileName, file);
    const tl::expected<std::string, std::string> text = Apps::ReadTextFileUpTo(path, LARGEST_HEADERS_FILE);
    if (!text.has_value())
    {
        mcs.AddError(key, fmt::format("{} cannot be read ({})", path, text.error()));
        return;
    }
    std::string_view rest = *text;
    for (std::size_t line = 1; !rest.empty(); ++line)
    {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        if (const std::string reason = AddHeader(rest.substr(0, end), config.headers); !reason.empty())
        {
            mcs.AddError(key, fmt::format("{} line {}: {}", path, line, reason));
        }
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    CheckSecretFile(mcs, key, path);
}

void ReadAllHeaders(
    const ConfigSection& mcs,
    const std::string& fileName,
    McsConfig& config,
    std::vector<std::string>& warnings)
{
    ReadHostHeader(mcs, config);
    ReadHeaders(mcs, config);
    if (!config.headers.empty())
    {
        WarnOfReadableConfig("mcs.headers", fileName, warnings);
        WarnOfPlainSecret("mcs.headers", config.url, "wss", warnings);
    }
    const std::size_t given = config.headers.size();
    ReadHeadersFile(mcs, fileName, config);
    if (config.headers.size() > given)
    {
        WarnOfPlainSecret("mcs.headers_file", config.url, "wss", warnings);
    }
}

/// The transport has a single setting: a ping is sent after half of the silence that ends a connection.
void ReadPing(const ConfigSection& mcs, McsConfig& config)
{
    config.pingInterval = mcs.GetDuration("ping_interval", 100ms, 10min, config.pingInterval);
    const std::chrono::milliseconds timeout = mcs.GetDuration("ping_timeout", 200ms, 20min, 2 * config.pingInterval);
    if (!mcs.HasKey("ping_interval"))
    {
        config.pingInterval = timeout / 2;
    }
    else if (timeout != 2 * config.pingInterval)
    {
        mcs.AddError(
            "ping_timeout",
            "must be twice mcs.ping_interval, because a ping is sent after half of the silence that ends a connection; give "
            "one of the two");
    }
}

void ReadSession(const ConfigSection& mcs, Protocol::SessionOptions& session)
{
    const auto readCount = [&mcs](const std::string& key, std::int64_t min, std::int64_t max, std::size_t& value) {
        value = static_cast<std::size_t>(mcs.GetInteger(key, min, max, static_cast<std::int64_t>(value)));
    };
    session.ackTimeout = mcs.GetDuration("ack_timeout", 10ms, 10min, session.ackTimeout);
    readCount("ack_retries", 0, MOST_RETRIES, session.ackRetries);
    readCount("ack_dead_after", 1, MOST_RETRIES, session.ackDeadAfter);
    readCount("window", 1, LARGEST_WINDOW, session.window);
    session.bAcksMatchedByCommand =
        mcs.GetWord("ack_match", {"id_then_command", "id"}, "id_then_command") == "id_then_command";
    readCount("max_rx_bytes", SMALLEST_TEXT, LARGEST_TEXT, session.codec.maximumBytes);
    session.codec.bUnknownMembersRefused = mcs.GetWord("unknown_fields", {"ignore", "reject"}, "ignore") == "reject";
    session.codec.bLegacyNames = mcs.IsEnabled("legacy_aliases", session.codec.bLegacyNames);
    session.codec.bLenientJSON = mcs.IsEnabled("json_lenient", session.codec.bLenientJSON);
}

void ReadStyle(const ConfigSection& mcs, McsConfig& config)
{
    MessageStyle& style = config.style;
    // One of the two allowed values is the empty text.
    const std::string unassigned = mcs.GetString("unassigned_robot_id", "null");
    style.bUnassignedRobotEmpty = unassigned.empty();
    if (!unassigned.empty() && unassigned != "null")
    {
        mcs.AddError("unassigned_robot_id", R"(expected "null" or "")");
    }
    style.bEmptyCarriersOmitted =
        mcs.GetWord("empty_carriers", {"positional_null", "omit"}, "positional_null") == "omit";
    style.bResultFailureIsFail = mcs.GetWord("result_report_failure", {"Failed", "Fail"}, "Failed") == "Fail";
    style.bRefusedReportsRetried = mcs.GetWord("on_report_nack", {"log", "retry"}, "log") == "retry";
    config.warnBytes = static_cast<std::size_t>(
        mcs.GetInteger("tx_warn_bytes", 0, LARGEST_TEXT, static_cast<std::int64_t>(config.warnBytes)));
    style.longestText = static_cast<std::size_t>(mcs.GetInteger("tx_max_bytes", 0, LARGEST_TEXT, 0));
    if (style.longestText > 0 && style.longestText < static_cast<std::size_t>(SMALLEST_TEXT))
    {
        mcs.AddError("tx_max_bytes", fmt::format("must be 0 (lists are never cut) or at least {}", SMALLEST_TEXT));
    }
}

void ReadErrors(
    const ConfigSection& root,
    const std::string& fileName,
    ErrorNames& names,
    std::vector<std::string>& errors)
{
    const ConfigSection section = root.GetSection("errors");
    const std::optional<std::string> map = section.GetStringOrNull("map");
    if (!map.has_value())
    {
        return;
    }
    const std::string path = ResolvePath(fileName, *map);
    if (const tl::expected<std::string, std::string> text = Apps::ReadTextFile(path); !text.has_value())
    {
        section.AddError(
            "map",
            fmt::format("{} cannot be read ({}); give the path of a file with names of errors", path, text.error()));
        return;
    }
    names = ReadErrorNames(path, errors);
}

} // namespace

std::string ResolvePath(const std::string& configFile, const std::string& path)
{
    if (path.starts_with(CREDENTIALS))
    {
        // NOLINTNEXTLINE(concurrency-mt-unsafe): the environment is never changed
        const char* const directoryOrNull = std::getenv("CREDENTIALS_DIRECTORY");
        return directoryOrNull == nullptr ? path : directoryOrNull + path.substr(CREDENTIALS.size());
    }
    const std::filesystem::path target(path);
    return target.is_absolute() ? path : (std::filesystem::path(configFile).parent_path() / target).string();
}

void ReadMcsConfig(
    const ConfigSection& root,
    const std::string& fileName,
    McsConfig& config,
    std::vector<std::string>& errors,
    std::vector<std::string>& warnings)
{
    const ConfigSection mcs = root.GetSection("mcs");
    config.url = mcs.GetURL("url", {EUrlScheme::Ws, EUrlScheme::Wss});
    ReadTLS(mcs, fileName, config);
    ReadAllHeaders(mcs, fileName, config, warnings);
    ReadPing(mcs, config);
    ReadSession(mcs, config.session);
    ReadStyle(mcs, config);
    const std::chrono::milliseconds interval =
        root.GetSection("position").GetDuration("interval", 0ms, 1min, config.session.positionInterval);
    if (interval > 0ms && interval < 10ms)
    {
        root.GetSection("position").AddError("interval", R"(must be "0s" (no positions) or at least "10ms")");
    }
    config.session.positionInterval = interval;
    const std::string replay = root.GetSection("outbox").GetWord("replay", {"all", "final_only", "none"}, "all");
    config.style.replay =
        replay == "all" ? EOutboxReplay::All : (replay == "none" ? EOutboxReplay::None : EOutboxReplay::FinalOnly);
    ReadErrors(root, fileName, config.style.errors, errors);
}

} // namespace ACS::Acsd
