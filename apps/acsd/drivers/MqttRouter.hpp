#pragma once

#include "trace/MessageTrace.hpp"
#include <acs/acsd/IMqttService.hpp>
#include <acs/core/Logger.hpp>
#include <acs/protocol_beast/EWireDirection.hpp>
#include <acs/vda5050/IMqttLink.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <unordered_map>
#include <vector>

namespace ACS::Acsd
{

/// Shares one connection to the broker between robots: passes each message to the robot with the longest prefix of its topic, the
/// states of the connection to all robots, and every message to the trace. The cost of a message depends neither on the number of
/// robots nor on the length of its topic, and it allocates nothing.
class MqttRouter final : public VDA5050::IMqttLinkListener
{
public:
    struct Dependencies
    {
        Core::Logger logger;
        MessageTrace* traceOrNull = nullptr;    ///< Outlives the router.
        std::function<void(bool bUp)> onLink{}; ///< Called before the robots receive the state; may be empty.
        std::function<bool()> isClosed{};       ///< Whether the robots receive nothing any more; empty: they always do.
        std::function<bool()> mayCommand{};     ///< Asked before each message that is sent; empty: it may.
    };

private:
    class Service;

    struct Hash
    {
        using is_transparent = void; // NOLINT(readability-identifier-naming): the name of the standard library

        [[nodiscard]] std::size_t operator()(std::string_view text) const noexcept
        {
            return std::hash<std::string_view>()(text);
        }
    };

    Dependencies _dependencies;
    VDA5050::IMqttLink* _linkOrNull = nullptr;
    std::vector<Service*> _services; ///< In the order of their creation.
    std::unordered_map<std::string, Service*, Hash, std::equal_to<>> _servicesByPrefix;
    std::size_t _mostLevels = 0; ///< Of a prefix.

public:
    explicit MqttRouter(Dependencies dependencies);
    MqttRouter(const MqttRouter&) = delete;
    MqttRouter& operator=(const MqttRouter&) = delete;
    ~MqttRouter() override;

    /// Set once, before a robot uses its service. The link outlives the services.
    void SetLink(VDA5050::IMqttLink& link);

    /// The service of a robot. No other robot has this prefix, which is not empty and has no wildcards. The router outlives the
    /// service, which must not be destroyed from within a call of a listener.
    [[nodiscard]] std::unique_ptr<IMqttService> MakeService(const std::string& robotID, const std::string& topicPrefix);

    void OnLinkUp() override;
    void OnLinkDown(std::error_code reason) override;
    void OnMqttMessage(const VDA5050::MqttMessage& message) override;

private:
    void Remove(const Service& service);
    [[nodiscard]] bool IsClosed() const;
    void ReportLink(bool bUp) const;
    [[nodiscard]] Service* FindServiceOrNull(std::string_view topic) const;
};

} // namespace ACS::Acsd
