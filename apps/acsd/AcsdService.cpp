#include "AcsdService.hpp"

#include "config/LiveConfig.hpp"
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

} // namespace

AcsdService::AcsdService(Acsd::Dependencies dependencies, AcsdConfig config, Handlers handlers)
    : _dependencies(std::move(dependencies)),
      _config(std::move(config)),
      _fingerprint(_config.store.postgres.has_value() ? MakeConfigFingerprint(_config) : std::string()),
      _handlers(std::move(handlers)),
      _guard(_leaseClock)
{
    if (_config.store.postgres.has_value())
    {
        _dependencies.mayCommand = [this] {
            return _guard.IsHeld();
        };
    }
    _dependencies.onStoreTaken = [this](const std::string& reason) {
        // Acsd cannot be destroyed from within its own call.
        boost::asio::post(_dependencies.executor, [this, reason] { LoseStore(reason); });
    };
}

AcsdService::~AcsdService()
{
    _guard.End();
    _opener.join();
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
    _state = EState::Standby;
    _keeper = std::make_unique<LeaseKeeper>(
        LeaseKeeper::Dependencies{_dependencies.executor, _leaseClock, _dependencies.logger.MakeFor("lease"), _guard},
        [store = _config.store,
         bMayCreate = _epoch == 0](std::function<bool()> shouldStop) -> std::unique_ptr<Planning::ILease> {
            Planning::PostgresOptions options = *store.postgres;
            options.timeout = store.lease / CALLS_PER_LEASE;
            options.shouldStop = std::move(shouldStop);
            options.bMayCreate = bMayCreate;
            return std::make_unique<Planning::PostgresLease>(std::move(options));
        },
        Planning::LeaseClaim{_config.store.instance, _fingerprint, _config.store.lease},
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
                StandbyServer::Reasons{
                    [this] { return _keeper->GetWaitReason(); },
                    [this] {
                        return _keeper->GetPublicReason();
                    }});
            return _standby->Listen(_config.http);
        })
        .map([this] {
            KeepPorts(_standby->GetAddresses());
            _watchdog.emplace(
                _dependencies.executor,
                Apps::LoopWatchdog::Options{_config.operations.stallLimit, _dependencies.aliveInterval},
                Apps::LoopWatchdog::Handlers{{}, _dependencies.onAlive});
            _watchdog->Start();
            _keeper->StartAfter(std::exchange(_pause, {}), std::exchange(_storeFault, {}));
        });
}

/// The lease is renewed while the store is read, however long that takes.
void AcsdService::OnTaken(std::uint64_t epoch)
{
    _state = EState::Opening;
    _epoch = epoch;
    boost::asio::post(_opener, [this, epoch, store = _config.store] {
        auto opened = std::make_shared<Core::Result<OpenedStore>>(OpenSharedStore(store, epoch, _guard));
        boost::asio::post(_dependencies.executor, [this, epoch, opened] { OnOpened(epoch, std::move(*opened)); });
    });
}

void AcsdService::OnOpened(std::uint64_t epoch, Core::Result<OpenedStore> store)
{
    if (_state != EState::Opening || epoch != _epoch)
    {
        return; // the lease was lost, or acsd stops
    }
    if (!store.has_value())
    {
        LoseStore(Core::Describe(store.error()));
        return;
    }
    _standby->Stop();
    _standby.reset();
    _watchdog.reset();
    if (const Core::Result<void> led = Lead(std::move(*store)); !led.has_value())
    {
        Fail(led.error());
    }
}

Core::Result<void> AcsdService::Lead(OpenedStore store)
{
    return Acsd::Create(_dependencies, _config, std::move(store)).map([this](std::unique_ptr<Acsd> acsd) {
        _state = EState::Leading;
        _acsd = std::move(acsd);
        KeepPorts(_acsd->GetAddresses());
        _acsd->Start();
    });
}

/// A store that no process can use is not taken several times a second, each time with new connections to all robots.
void AcsdService::LoseStore(const std::string& reason)
{
    if (_config.store.postgres.has_value() && (_state == EState::Opening || _state == EState::Leading))
    {
        _pause = _takeoverPause.OnFault(_leaseClock.GetNow().steady, _config.store.lease);
        _storeFault = reason;
    }
    LoseLead(reason);
}

void AcsdService::LoseLead(const std::string& reason)
{
    _guard.End();
    if (!_config.store.postgres.has_value())
    {
        _dependencies.logger.Error(
            "another program has taken the path of the store: acsd ends now; its own store is where it was moved to",
            {{"reason", reason}});
        _handlers.onFailed();
        return;
    }
    if (_state == EState::Stopping)
    {
        if (std::exchange(_acsd, nullptr) != nullptr)
        {
            Finish();
        }
        return;
    }
    if (_state != EState::Opening && _state != EState::Leading)
    {
        return;
    }
    _dependencies.logger.Error(
        "this process does not lead any more; its connections are closed, and it is a standby",
        {{"reason", reason}});
    _state = EState::Standby;
    _acsd.reset();
    // Released, so that this process or another one can take it at once. Not from within a call of the keeper.
    _keeper->ReleaseAsync([this] { BecomeStandbyLater(); });
}

void AcsdService::BecomeStandbyLater()
{
    boost::asio::post(_dependencies.executor, [this] {
        if (_state != EState::Standby)
        {
            return;
        }
        if (_standby != nullptr)
        {
            _standby->Stop();
            _standby.reset();
        }
        if (const Core::Result<void> standing = StartStandby(); !standing.has_value())
        {
            Fail(standing.error());
        }
    });
}

void AcsdService::StopAsync()
{
    _state = EState::Stopping;
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
    _watchdog.reset();
    if (_keeper == nullptr)
    {
        _handlers.onStopped();
        return;
    }
    _keeper->ReleaseAsync([this] { _handlers.onStopped(); });
}

void AcsdService::Fail(const Core::Error& error) const
{
    _dependencies.logger.Error(
        "acsd ends, because it cannot open again what it had opened",
        {{"reason", Core::Describe(error)}});
    _handlers.onFailed();
}

void AcsdService::Reload(const AcsdConfig& fresh)
{
    if (_acsd != nullptr)
    {
        _acsd->Reload(fresh);
    }
    else
    {
        LogChange(_config, fresh, _dependencies.logger.MakeFor("config"));
    }
    ApplyLiveKeys(fresh, _config);
    if (_standby != nullptr)
    {
        _standby->Reload(fresh.http.control, _config.http.control);
    }
    else if (fresh.http.control.tokensFile == _config.http.control.tokensFile)
    {
        _config.http.control.access.tokens = fresh.http.control.access.tokens;
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
