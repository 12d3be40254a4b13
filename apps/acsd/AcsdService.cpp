#include "AcsdService.hpp"

#include "operator/AuditLog.hpp"
#include "replay/RecordedConfig.hpp"
#include <acs/plan_postgres/PostgresLease.hpp>

#include <boost/asio/post.hpp>

#include <utility>

namespace ACS::Acsd
{

namespace
{

/// A call of the lease that takes longer is of no use.
constexpr int CALLS_PER_LEASE = 2;

Planning::PostgresOptions MakeLeaseOptions(const StoreConfig& store)
{
    Planning::PostgresOptions options = *store.postgres;
    options.timeout = store.lease / CALLS_PER_LEASE;
    return options;
}

} // namespace

AcsdService::AcsdService(Acsd::Dependencies dependencies, AcsdConfig config, Handlers handlers)
    : _dependencies(std::move(dependencies)),
      _config(std::move(config)),
      _handlers(std::move(handlers)),
      _guard(_dependencies.clock)
{
    if (_config.store.postgres.has_value())
    {
        _dependencies.mayCommand = [this] {
            return _guard.IsHeld();
        };
    }
    _dependencies.onStoreTaken = [this] {
        // Acsd cannot be destroyed from within its own call.
        boost::asio::post(_dependencies.executor, [this] { LoseLead("another process has taken the store"); });
    };
}

Core::Result<void> AcsdService::Start()
{
    if (_config.store.postgres.has_value())
    {
        return StartStandby();
    }
    return OpenDirectoryStore(_config.store).and_then([this](OpenedStore store) { return Lead(std::move(store)); });
}

Core::Result<void> AcsdService::StartStandby()
{
    _keeper = std::make_unique<LeaseKeeper>(
        LeaseKeeper::Dependencies{
            _dependencies.executor,
            _dependencies.clock,
            _dependencies.logger.MakeFor("lease"),
            _guard},
        std::make_unique<Planning::PostgresLease>(MakeLeaseOptions(_config.store)),
        Planning::LeaseClaim{_config.store.instance, MakeConfigFingerprint(_config), _config.store.lease},
        LeaseKeeper::Handlers{
            [this](std::uint64_t epoch) { OnTaken(epoch); },
            [this](const std::string& reason) {
                LoseLead(reason);
            }});
    const OperatorConfig& control = _config.http.control;
    return AuditLog::Create(
               control.auditDirectory,
               control.auditLimits,
               _dependencies.clock,
               _dependencies.logger.MakeFor("audit"))
        .and_then([this](std::unique_ptr<AuditLog> audit) {
            _standby = std::make_unique<StandbyServer>(
                HttpInterfaces::Dependencies{_dependencies.executor, _dependencies.clock, _dependencies.logger},
                _config.http,
                std::move(audit),
                [this] { return _keeper->GetWaitReason(); });
            return _standby->Listen(_config.http);
        })
        .map([this] {
            KeepPorts(_standby->GetAddresses());
            _keeper->Start();
        });
}

/// Only what could be opened at the start can fail later: the end of the process shows it.
void AcsdService::OnTaken(std::uint64_t epoch)
{
    _standby->Stop();
    _standby.reset();
    const Core::Result<void> led = OpenSharedStore(_config.store, epoch, _guard).and_then([this](OpenedStore store) {
        return Lead(std::move(store));
    });
    if (!led.has_value())
    {
        _handlers.onFailed(Core::Describe(led.error()));
    }
}

Core::Result<void> AcsdService::Lead(OpenedStore store)
{
    return Acsd::Create(_dependencies, _config, std::move(store)).map([this](std::unique_ptr<Acsd> acsd) {
        _acsd = std::move(acsd);
        KeepPorts(_acsd->GetAddresses());
        _acsd->Start();
    });
}

void AcsdService::LoseLead(const std::string& reason)
{
    _guard.End();
    if (!_config.store.postgres.has_value())
    {
        _handlers.onFailed(reason);
        return;
    }
    if (_acsd == nullptr)
    {
        return;
    }
    _dependencies.logger.Error("this process does not lead any more: all connections are closed", {{"reason", reason}});
    _acsd.reset();
    if (_bStopping)
    {
        _handlers.onStopped();
        return;
    }
    // Not from within a call of the keeper.
    boost::asio::post(_dependencies.executor, [this] {
        if (const Core::Result<void> standing = StartStandby(); !standing.has_value())
        {
            _handlers.onFailed(Core::Describe(standing.error()));
        }
    });
}

void AcsdService::StopAsync()
{
    _bStopping = true;
    if (_acsd != nullptr)
    {
        _acsd->StopAsync([this] { Finish(); });
        return;
    }
    Finish();
}

void AcsdService::Finish()
{
    if (_standby != nullptr)
    {
        _standby->Stop();
    }
    if (_keeper == nullptr)
    {
        _handlers.onStopped();
        return;
    }
    _keeper->ReleaseAsync([this] { _handlers.onStopped(); });
}

void AcsdService::Reload(const AcsdConfig& fresh)
{
    if (_acsd != nullptr)
    {
        _acsd->Reload(fresh);
    }
}

std::vector<Apps::ReadyAddress> AcsdService::GetAddresses() const
{
    return _acsd != nullptr ? _acsd->GetAddresses() : _standby->GetAddresses();
}

/// Port 0 selects a free port once.
void AcsdService::KeepPorts(const std::vector<Apps::ReadyAddress>& addresses)
{
    for (const Apps::ReadyAddress& address : addresses)
    {
        HttpListenConfig& config = address.name == "http" ? _config.http.monitoring : _config.http.control.http;
        config.listen.port = address.endpoint.port;
    }
}

} // namespace ACS::Acsd
