// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/glm.hpp>

// The BSDF of paths: docs/pipeline.md, "Paths", "Surfaces" and "Directions".
// Heitz 2014, "Understanding the Masking-Shadowing Function"; Heitz 2018, "Sampling the GGX
// Distribution of Visible Normals".

namespace afterglow::reference {

inline double luminanceOf(const glm::dvec3& c) {
    return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
}

/// One value for each lobe.
struct Lobes {
    glm::dvec3 diffuse{0.0}, specular{0.0};

    glm::dvec3 sum() const { return diffuse + specular; }
    Lobes operator*(const glm::dvec3& factor) const {
        return {diffuse * factor, specular * factor};
    }
    Lobes operator*(double factor) const { return {diffuse * factor, specular * factor}; }
    Lobes operator+(const Lobes& other) const {
        return {diffuse + other.diffuse, specular + other.specular};
    }
};

/// The factors of a glTF material.
struct MaterialFactors {
    glm::dvec3 baseColor{0.0};
    double metallic = 0.0, roughness = 1.0;

    double alpha() const { return std::max(roughness * roughness, 1e-3); }
    glm::dvec3 normalReflectance() const { return (1.0 - metallic) * 0.04 + metallic * baseColor; }
    glm::dvec3 diffuseReflectance() const { return (1.0 - metallic) * baseColor; }
};

/// s(c) of the text: c + s(c) = 2 c / G1(c).
inline double smithRoot(double c, double alpha) {
    return std::sqrt(c * c * (1.0 - alpha * alpha) + alpha * alpha);
}
inline double maskingG1(double cv, double alpha) {
    return 2.0 * cv / (cv + smithRoot(cv, alpha));
}
/// G2 / G1: the part of the light from a visible microfacet that leaves the surface.
inline double shadowingRatio(double cl, double cv, double alpha) {
    if (!(cl > 0.0))
        return 0.0;
    const double sv = smithRoot(cv, alpha), sl = smithRoot(cl, alpha);
    return cl * (cv + sv) / (cl * sv + cv * sl);
}
/// GGX. 1 - (n . h)^2 is taken from the tangent part of h: near the mirror nothing cancels.
inline double normalDensity(double nh, double tangentSquare, double alpha) {
    const double x = tangentSquare + nh * nh * alpha * alpha;
    return alpha * alpha / (std::numbers::pi * x * x);
}
inline double schlickPower(double u) {
    return std::pow(std::clamp(1.0 - u, 0.0, 1.0), 5.0);
}

/// A visible normal around v, in the frame whose z is the normal; v is of unit length, v.z > 0.
/// Heitz 2018, listing 1, with both roughnesses alike.
inline glm::dvec3 visibleNormal(const glm::dvec3& v, double alpha, double u1, double u2) {
    const glm::dvec3 stretched = glm::normalize(glm::dvec3(alpha * v.x, alpha * v.y, v.z));
    const double across = std::hypot(stretched.x, stretched.y);
    const glm::dvec3 t1 = across > 0.0 ? glm::dvec3(-stretched.y, stretched.x, 0.0) / across
                                       : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 t2 = glm::cross(stretched, t1);
    const double r = std::sqrt(u1), angle = 2.0 * std::numbers::pi * u2;
    const double x = r * std::cos(angle);
    const double s = 0.5 * (1.0 + stretched.z);
    const double y = (1.0 - s) * std::sqrt(std::max(0.0, 1.0 - x * x)) + s * r * std::sin(angle);
    const double z = std::sqrt(std::max(0.0, 1.0 - x * x - y * y));
    const glm::dvec3 h = x * t1 + y * t2 + z * stretched;
    return glm::normalize(glm::dvec3(alpha * h.x, alpha * h.y, std::max(0.0, h.z)));
}

/// Albedo of the specular lobe: F0 a + b.
struct SplitAlbedo {
    double a = 0.0, b = 0.0;

    glm::dvec3 of(const glm::dvec3& f0) const { return f0 * a + b; }
};

/// The mean over a grid of n x n visible normals.
inline SplitAlbedo albedoOverGrid(double alpha, double cv, int n) {
    const glm::dvec3 v(std::sqrt(1.0 - cv * cv), 0.0, cv);
    SplitAlbedo sum;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const glm::dvec3 h = visibleNormal(v, alpha, (i + 0.5) / n, (j + 0.5) / n);
            const double hv = glm::dot(h, v);
            const double ratio = shadowingRatio(2.0 * hv * h.z - cv, cv, alpha);
            sum.a += ratio * (1.0 - schlickPower(hv));
            sum.b += ratio * schlickPower(hv);
        }
    return {sum.a / (n * n), sum.b / (n * n)};
}

/// The table of A and B over roughness and c_v.
class AlbedoTable {
public:
    static constexpr int kSize = 32;

    AlbedoTable() {
        for (int r = 0; r < kSize; ++r)
            for (int c = 0; c < kSize; ++c) {
                const double roughness = double(r) / (kSize - 1);
                values_[r][c] = albedoOverGrid(std::max(roughness * roughness, 1e-3),
                                               std::max(double(c) / (kSize - 1), 1e-3), kSize);
            }
    }

    const SplitAlbedo& texel(int r, int c) const { return values_[r][c]; }

    /// Bilinear, clamped to the centers of the border.
    SplitAlbedo at(double roughness, double cv) const {
        const double x = std::clamp(roughness, 0.0, 1.0) * (kSize - 1.0);
        const double y = std::clamp(cv, 0.0, 1.0) * (kSize - 1.0);
        const int i = std::min(int(x), kSize - 2), j = std::min(int(y), kSize - 2);
        SplitAlbedo out;
        for (const int di : {0, 1})
            for (const int dj : {0, 1}) {
                const double weight = (di ? x - i : 1.0 - x + i) * (dj ? y - j : 1.0 - y + j);
                out.a += weight * values_[i + di][j + dj].a;
                out.b += weight * values_[i + di][j + dj].b;
            }
        return out;
    }

private:
    std::array<std::array<SplitAlbedo, kSize>, kSize> values_;
};
inline const AlbedoTable& albedoTable() {
    static const AlbedoTable table;
    return table;
}

/// Scattering at a point towards one direction.
class Bsdf {
public:
    /// n, geometric, toViewer: unit vectors, all in the same space. `leastAlpha`: kappa of a
    /// surface that is seen by a path, 0 of one that the camera sees.
    Bsdf(const MaterialFactors& material, const glm::dvec3& n, const glm::dvec3& geometric,
         const glm::dvec3& toViewer, double leastAlpha = 0.0)
        : n_(n), geometric_(geometric), f0_(material.normalReflectance()),
          alpha_(std::max(material.alpha(), leastAlpha)) {
        // A direction below the horizon of n is moved to it.
        const double across = glm::dot(n, toViewer);
        v_ = glm::normalize(toViewer + (std::max(across, 1e-3) - across) * n);
        cv_ = glm::dot(n, v_);
        // Where kappa does not widen the lobe it changes nothing, exactly.
        const double roughness = alpha_ > material.alpha() ? std::sqrt(alpha_) : material.roughness;
        albedo_.specular = albedoTable().at(roughness, cv_).of(f0_);
        albedo_.diffuse = material.diffuseReflectance() * (1.0 - albedo_.specular);
        const double diffuse = luminanceOf(albedo_.diffuse);
        const double specular = luminanceOf(albedo_.specular);
        specularShare_ = diffuse == 0.0    ? 1.0
                         : specular == 0.0 ? 0.0
                                           : std::clamp(specular / (specular + diffuse), 0.1, 0.9);
    }

    const Lobes& albedo() const { return albedo_; } ///< D and E
    double alpha() const { return alpha_; }
    double specularShare() const { return specularShare_; } ///< p
    const glm::dvec3& view() const { return v_; }           ///< v'
    double cosine() const { return cv_; }                   ///< c_v

    bool scatters(const glm::dvec3& l) const {
        return glm::dot(n_, l) > 0.0 && glm::dot(geometric_, l) > 0.0;
    }

    /// f_d and f_s.
    Lobes at(const glm::dvec3& l) const {
        if (!scatters(l))
            return {};
        const glm::dvec3 h = glm::normalize(v_ + l);
        const double cl = glm::dot(n_, l);
        const glm::dvec3 fresnel = f0_ + (1.0 - f0_) * schlickPower(glm::dot(h, v_));
        const double visible = 0.5 / (cl * smithRoot(cv_, alpha_) + cv_ * smithRoot(cl, alpha_));
        return {albedo_.diffuse / std::numbers::pi, fresnel * (normalDensity(h) * visible)};
    }

    /// Of the directions that `direction` gives, with respect to solid angle; also below the
    /// horizon, where nothing is scattered.
    double density(const glm::dvec3& l) const {
        return specularShare_ * specularDensity(l) +
               (1.0 - specularShare_) * std::max(glm::dot(n_, l), 0.0) / std::numbers::pi;
    }
    double specularDensity(const glm::dvec3& l) const {
        const glm::dvec3 h = glm::normalize(v_ + l);
        if (!(glm::dot(n_, h) > 0.0))
            return 0.0;
        return maskingG1(cv_, alpha_) * normalDensity(h) / (4.0 * cv_);
    }

    /// t: a unit tangent. u3, u4: the direction in the lobe; u5: which lobe.
    glm::dvec3 direction(const glm::dvec3& t, double u3, double u4, double u5) const {
        const glm::dmat3 frame(t, glm::cross(n_, t), n_);
        if (u5 < specularShare_) {
            const glm::dvec3 h = frame * visibleNormal(glm::transpose(frame) * v_, alpha_, u3, u4);
            return 2.0 * glm::dot(v_, h) * h - v_;
        }
        const double r = std::sqrt(u3), angle = 2.0 * std::numbers::pi * u4;
        return frame * glm::dvec3(r * std::cos(angle), r * std::sin(angle),
                                  std::sqrt(std::max(0.0, 1.0 - u3)));
    }

private:
    double normalDensity(const glm::dvec3& h) const {
        const glm::dvec3 across = glm::cross(n_, h);
        return reference::normalDensity(glm::dot(n_, h), glm::dot(across, across), alpha_);
    }

    glm::dvec3 n_, geometric_, v_{0.0}, f0_;
    double alpha_, cv_ = 1.0, specularShare_ = 1.0;
    Lobes albedo_;
};

} // namespace afterglow::reference
