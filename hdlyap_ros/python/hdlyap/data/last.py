"""What is known of one run, whether it was recorded or still goes on."""

from . import space


class Last:
    """Its run_info, its last spectrum (None without exponents), its last steps, covariant
    vectors, widths and gas (None if nobody listened)."""

    is_mean = False  # over seeds
    left_out = ()  # lines of runs that are in none of its means
    info = spectrum = steps = covariant = localization = gas = None

    @property
    def positive_end(self):
        """Lyapunov index of the last positive exponent."""
        return (self.phase_space - self.info.zero_exponents) // 2

    @property
    def phase_space(self):
        """Its dimension: exponents in all."""
        return space.phase_space(self.info)

    @property
    def last_index(self):
        """Lyapunov index of the last exponent carried."""
        return self.spectrum.first_index + len(self.spectrum.exponents) - 1

    @property
    def sum_name(self):
        """Of the sum of the positive exponents carried."""
        return 'h_KS' if self.last_index >= self.positive_end else 'sum of exponents'

    @property
    def sum_error(self):
        """Of that sum; -1 while not yet known."""
        return self.spectrum.ks_entropy_error
