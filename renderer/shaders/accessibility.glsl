// Accessibility of one sample as printed in Jakobsen 2010, appendix B. `nearer` is how far the
// scene at the sample lies in front of the *pixel* (not of the sample: the appendix' own
// choice), in radii. Known faults, kept: accessibility falls as the difference grows, the reverse
// of Filion and McNaughton's second rule, and jumps back to 1 at noOcclusion, a hard-edged halo.
float accessibility(float nearer) {
    if (nearer < settings.fullOcclusion || nearer > settings.noOcclusion)
        return 1.0;
    float scaled = nearer / settings.attenuation;
    return pow(1.0 / (1.0 + scaled * scaled), settings.accessibilityPower);
}
