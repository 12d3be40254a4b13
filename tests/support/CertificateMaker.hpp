#pragma once

#include <chrono>
#include <filesystem>
#include <string>

namespace ACS::Testing
{

/// A certificate and its key on disk.
struct CertificateFiles
{
    std::string certificate;
    std::string key;
};

/// The content of a certificate.
struct CertificateRequest
{
    std::string alternativeName = "DNS:localhost,IP:127.0.0.1"; ///< In the format of OpenSSL's configuration.
    std::chrono::hours validFrom{-24};                          ///< Relative to now.
    std::chrono::hours validTo{24};
    bool bRSA = false;
    std::string passphrase{}; ///< Of the key file; empty: none.
    std::string commonName{}; ///< Empty: one with a number.
};

/// Makes certificates during a test in the given folder: none is kept in the repository, none expires.
class CertificateMaker
{
    std::filesystem::path _folder;
    int _count = 0;

public:
    explicit CertificateMaker(std::filesystem::path folder);

    [[nodiscard]] CertificateFiles MakeCA(const std::string& name);
    [[nodiscard]] CertificateFiles Make(const CertificateFiles& ca, const CertificateRequest& wish);
    [[nodiscard]] CertificateFiles MakeSelfSigned(const CertificateRequest& wish);

    /// Writes a file with this text and returns its path.
    [[nodiscard]] std::string WriteFile(const std::string& name, const std::string& text) const;
};

} // namespace ACS::Testing
